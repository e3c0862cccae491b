#include "solver/executor.h"

#include <algorithm>

namespace clothsim {

void addTime(std::vector<PassTime>& times, const std::string& name, double seconds) {
  auto found =
      std::find_if(times.begin(), times.end(), [&](const PassTime& time) { return time.name == name; });
  if (found == times.end()) found = times.insert(found, {name, 0});
  found->seconds += seconds;
}

}  // namespace clothsim
