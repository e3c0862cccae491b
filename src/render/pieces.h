// Which pieces of the cloth are drawn: all, or one that has a look of its own.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace clothsim {

template <class T>
[[nodiscard]] std::span<T> piecesOf(std::span<T> all, std::optional<std::size_t> only) {
  return only ? all.subspan(*only, 1) : all;
}

}  // namespace clothsim
