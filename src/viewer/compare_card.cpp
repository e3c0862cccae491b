#include "viewer/compare_card.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "simulation/gpu/solvers.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr int mostComparedSteps = 900;
constexpr double mostSeconds = 4;  // for both backends together
constexpr double atOnce = 0.05;    // on a backend before the window is served [s]
constexpr double resultSeconds = 12;
constexpr double mostCovered = 0.45;  // of the picture
constexpr float cardMargin = 0.8f;    // em
constexpr const char* backendLabels[] = {"GPU", "CPU"};

std::string secondsText(double seconds) {
  char text[32];
  if (seconds < 1)
    std::snprintf(text, sizeof text, "%.1f ms", 1000 * seconds);
  else
    std::snprintf(text, sizeof text, "%.2f s", seconds);
  return text;
}

std::string rateText(double rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g million/s", rate / 1e6);
  return text;
}

void rowOf(const char* label, const std::string& gpu, const std::string& cpu) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  quietText(label);
  for (const std::string& value : {gpu, cpu}) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
  }
}

}  // namespace

void CompareCard::start(Session& session) {
  close();
  const Simulation& simulation = session.simulation();
  const State state = session.simulation().state();
  cloth_ = simulation.sharedCloth();
  for (Side* side : {&gpu_, &cpu_}) {
    side->solver = makeSolver(side == &gpu_ ? "gpu" : "cpu", *cloth_, simulation.sharedScene());
    side->solver->setState(state);
    side->device = side->solver->device();
    side->device.erase(std::min(side->device.size(), side->device.find_first_of("(/")));
    if (side->device.starts_with("CPU, ")) side->device.erase(0, 5);
  }
  particles_ = (*cloth_)->particleCount();
  running_ = open_ = true;
}

void CompareCard::step(Side& side, int count) const {
  const auto begin = std::chrono::steady_clock::now();
  side.solver->step(count);
  side.solver->finish();
  side.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void CompareCard::advance() {
  if (!running_) return;
  const double before = std::max(gpu_.seconds, cpu_.seconds);
  const int count = std::min(stepsAtOnce_, mostComparedSteps - steps_);
  step(gpu_, count);
  step(cpu_, count);
  steps_ += count;
  if (std::max(gpu_.seconds, cpu_.seconds) - before < atOnce / 2) stepsAtOnce_ *= 2;
  const bool done = steps_ >= mostComparedSteps || gpu_.seconds + cpu_.seconds > mostSeconds;
  if (!done) return;
  running_ = false;
  secondsLeft_ = resultSeconds;
  difference_ = difference(gpu_.solver->state(), cpu_.solver->state());
  gpu_.solver.reset();
  cpu_.solver.reset();
  cloth_.reset();
}

void CompareCard::close() {
  gpu_ = {};
  cpu_ = {};
  cloth_.reset();
  steps_ = 0;
  stepsAtOnce_ = 1;
  difference_ = {};
  running_ = open_ = false;
}

void CompareCard::pass(double seconds) {
  if (!open_ || running_ || pointedAt_) return;
  secondsLeft_ -= seconds;
  if (secondsLeft_ <= 0) close();
}

CoveredEdges CompareCard::coveredEdges(PictureArea area) const {
  if (!open_ || area.width <= 0 || area.height <= 0) return {};
  const double right = double{width_ / area.width}, top = double{height_ / area.height};
  // The card counts as covering the edge that leaves more of the picture.
  if (right < top) return {.right = std::min(right, mostCovered)};
  return {.top = std::min(top, mostCovered)};
}

void CompareCard::draw(PictureArea area) {
  if (!open_) return;
  const float right = std::max(area.width, width_) - cardMargin * em();  // over the panels if need be
  ImGui::SetNextWindowPos({right, cardMargin * em()}, ImGuiCond_Always, {1, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::sheet);
  ImGui::Begin("compare", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  titleText("GPU and CPU compared");
  if (ImGui::BeginTable("sides", 3, ImGuiTableFlags_SizingFixedFit)) {
    rowOf("", backendLabels[0], backendLabels[1]);
    rowOf("device", gpu_.device, cpu_.device);
    rowOf("time", secondsText(gpu_.seconds), secondsText(cpu_.seconds));
    const double work = static_cast<double>(particles_) * steps_;
    rowOf("particle steps", rateText(work / std::max(1e-9, gpu_.seconds)),
          rateText(work / std::max(1e-9, cpu_.seconds)));
    ImGui::EndTable();
  }
  if (running_) {
    quietText("step " + std::to_string(steps_) + " of " + std::to_string(mostComparedSteps) + " ...");
  } else {
    const std::string verdict = std::to_string(difference_.differing) + " of " +
                                std::to_string(difference_.floats) + " floats differ after " +
                                std::to_string(steps_) + " steps";
    coloredText(verdict, difference_.differing == 0 ? theme::good : theme::alert);
  }
  if (wideButton(running_ ? "Stop" : "Close")) close();
  pointedAt_ = ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows);
  width_ = ImGui::GetWindowWidth() + 2 * cardMargin * em();
  height_ = ImGui::GetWindowHeight() + 2 * cardMargin * em();
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace clothsim
