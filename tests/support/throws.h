// The message of the error that a call throws, for tests that look into it.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace clothsim::test {

// "" and a failed expectation when nothing of that kind is thrown.
template <class Expected, class Call>
std::string messageThrownBy(Call&& call) {
  try {
    call();
  } catch (const Expected& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace clothsim::test
