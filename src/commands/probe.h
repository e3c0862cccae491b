// What `clothsim probe` measures of an OpenGL driver, in blocks. Each finding is a line of JSON, printed at
// once: who runs out of time still has those before. All need a current context.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace clothsim {

using ProbeLine = std::function<void(const nlohmann::ordered_json&)>;

// @throws UsageError that says so
[[noreturn]] void complainNothingMatches(const std::string& only);

// Name, version and the limits that the passes depend on.
void probeLimits(const ProbeLine& line);
// Seconds to compile and link each program of the usual configurations. [s]
void probePrograms(const ProbeLine& line);
// Both backends over scenes, integrators, cuts, shapes of work groups and a large grid: numbers that differ,
// and the first step and pass in which they do. `small`: fewer points and frames. `only`:
// the cases whose names contain it. Returns whether all bits are equal.
[[nodiscard]] bool probeContract(bool small, const std::string& only, const ProbeLine& line);
// What a dispatch costs by itself, by the barrier behind it and what else changes in between. [us]
void probeDispatches(bool small, const ProbeLine& line);
// What the device can do at best: copies [GB/s], the loads of a step [us], the springs of a step [1/s].
void probeRoofs(bool small, const ProbeLine& line);
// Steps of the usual configurations: time, time to submit, dispatches, time of each pass. [us/step]
// `only`: of those whose names contain it.
void probeSteps(bool small, const std::string& only, const ProbeLine& line);
// Explicit steps with other shapes of work groups. [us/step]
void probeGroups(bool small, const ProbeLine& line);
// The demo, simulated and drawn in 3840 x 2160 pixels. [ms]
void probeDemo(bool small, const ProbeLine& line);

}  // namespace clothsim
