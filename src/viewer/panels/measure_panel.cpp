#include "viewer/panels/measure_panel.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "core/error.h"
#include "core/files.h"
#include "core/formatted.h"
#include "viewer/panels/plot.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr double sampleSeconds = 0.25;  // between two samples, at least
constexpr double shareOfTime = 0.1;     // of the time, for sampling
constexpr std::size_t mostSamples = 240;
constexpr int timedSteps = 60;

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void row(const char* label, const std::string& value, const char* help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  quietText(label);
  helpTip(help);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
  helpTip(help);
}

bool beginRows(const char* id) { return ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp); }

// The resident memory of the process [bytes]; 0 where /proc is missing.
std::size_t residentBytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::string megabytes(std::size_t bytes) {
  return formatted("%.1f MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

}  // namespace

void MeasurePanel::stepped(double particleSteps, double seconds) {
  particleSteps_ += particleSteps;
  seconds_ += seconds;
}

void MeasurePanel::forget(Session& session) {
  samples_.clear();
  springsOf_.reset();  // another session numbers its cloths anew
  nextSample_ = 0;
  passes_.clear();
  watch_ = {};
  implicitSteps_ = {};
  contactsBefore_ = {};
  session.simulation().forgetContactCounts();
}

void MeasurePanel::keepCounts(Session& session) {
  contactsBefore_ = contactsBefore_ + session.simulation().contactCounts();
  session.simulation().forgetContactCounts();
}

void MeasurePanel::dropFuture(const Session& session) {
  const Simulation& simulation = session.simulation();
  while (!samples_.empty() && samples_.back().time > simulation.time()) samples_.pop_back();
  watch_ = {};
  contactsBefore_ = {};
  if (samples_.empty()) return watch_.startWithoutState(simulation.cloth(), simulation.scene());
  watch_ = samples_.back().watch;
  contactsBefore_ = samples_.back().contacts;
}

std::vector<Warning> MeasurePanel::warnings(const Scene& scene) const {
  std::vector<Warning> warnings = watch_.warnings(scene);
  const ConvergenceCounts recent = implicitSteps_.recent();
  if (isImplicit(scene.solver.integrator) && recent.unconvergedSteps > 0)
    warnings.push_back(convergenceWarning(recent, implicitSteps_.largestUpdate(), scene));
  return warnings;
}

void MeasurePanel::sampleSteps(Session& session, double now) {
  implicitSteps_.add(session.simulation().time(), session.simulation().convergenceCounts());
  nextSample_ = now + sampleSeconds;
}

void MeasurePanel::sample(Session& session, double now, std::optional<std::uint32_t> underCursor) {
  const double began = secondsNow();
  const Simulation& simulation = session.simulation();
  const Cloth& cloth = simulation.cloth();
  if (springsOf_ != session.clothGeneration()) {
    springs_ = cloth.springs();
    springsOf_ = session.clothGeneration();
    samples_.clear();
    watch_ = {};
    watch_.startWithoutState(cloth, simulation.scene());
  }
  const State state = session.simulation().solver().state();
  const Energies energy = energies(cloth, springs_, simulation.scene(), session.cuts(), state);
  contacts_ = contactsBefore_ + session.simulation().contactCounts();
  seamGap_ = seamGap(cloth, simulation.scene(), state).distance;
  watch_.add(session.frameSinceStart(), cloth, simulation.scene(), state, energy.maxStrain, contacts_);
  if (samples_.empty() || simulation.time() > samples_.back().time)
    samples_.push_back({simulation.time(), energy, watch_, contacts_});
  if (samples_.size() > mostSamples) samples_.pop_front();
  underCursor_.reset();
  if (underCursor)
    underCursor_ = {*underCursor, factsOf(*underCursor, cloth, springs_, session.cuts(), state)};
  rate_ = seconds_ > 0 ? particleSteps_ / seconds_ : 0;
  particleSteps_ = seconds_ = 0;
  nextSample_ = now + std::max(sampleSeconds, (secondsNow() - began) / shareOfTime);
}

void MeasurePanel::drawNumbers(const Scene& scene) {
  if (!beginRows("numbers")) return;
  const Energies last = samples_.empty() ? Energies{} : samples_.back().energies;
  row("max strain", formatted("%.2f %%", 100 * last.maxStrain),
      "The largest stretch l/L - 1 of all springs that are enabled and not cut.");
  drawUnderCursor();
  drawContacts(scene.solver.selfCollision);
  if (!scene.seams.empty())
    row("seam gap", formatted("%.3g mm", 1000 * seamGap_),
        "How far points that a seam joins are apart at most, beyond the length that it leaves them now.");
  if (isImplicit(scene.solver.integrator)) drawConvergence();
  row("particle steps", rate_ > 0 ? formatted("%.3g million/s", rate_ / 1e6) : "-",
      "Particles times steps computed per second.");
  ImGui::EndTable();
}

// Rows of the table of numbers.
void MeasurePanel::drawUnderCursor() {
  if (!underCursor_) return row("under the cursor", "-", "Point at the cloth to see what happens there.");
  const ParticleFacts& facts = underCursor_->facts;
  row("under the cursor", "particle " + std::to_string(underCursor_->particle),
      "The particle under the mouse, by its number in exported files.");
  row("speed", formatted("%.3g m/s", facts.speed), "Of that particle.");
  row("strain", formatted("%+.2f %%", 100 * facts.strain), "Of its most strained spring, l/L - 1.");
  row("force", formatted("%.3g N", facts.force),
      "Of that spring, k (l - L): it pulls where positive. Edges of a membrane are no springs: 0.");
}

void MeasurePanel::drawContacts(SelfCollision mode) {
  const auto number = [](std::uint64_t count) { return static_cast<unsigned long long>(count); };
  if (contacts_.passages > 0)
    row("passed by colliders",
        formatted("%llu in %llu steps", number(contacts_.passages), number(contacts_.passageSteps)),
        "Triangles that small colliders went through.");
  if (mode == SelfCollision::contact) {
    row("pairs in contact", formatted("at most %llu", number(contacts_.pairs)),
        "Parts of the surface that may touch, the most in a step so far.");
    row("motions cut short",
        formatted("%llu in %llu steps", number(contacts_.shortened), number(contacts_.clampedSteps)),
        "Motions of particles that would have brought parts of the surface through each other.");
    row("pins kept back", formatted("%.3g mm", 1000 * contacts_.pinLag),
        "How far a pin was kept from its path at the end of a step, at most: layers between pins stop them, "
        "too.");
    row("largest correction", formatted("%.3g mm", 1000 * contacts_.largestCorrection),
        "How far parts of the surface that were too near were pushed apart at the end of a step, at most; "
        "they "
        "may end it that far inside a collider.");
    return;
  }
  const std::string pairs = formatted("%llu", number(watch_.contacts().contacts()));
  row("self-contacts",
      mode == SelfCollision::off   ? "off"
      : contacts_.clampedSteps > 0 ? pairs + formatted(", %llu ", number(contacts_.clampedSteps)) +
                                         (contacts_.clampedSteps == 1 ? "step guarded" : "steps guarded")
                                   : pairs,
      "Pairs of particles that touch and are not neighbours on the cloth. In a guarded step motion had to "
      "be shortened.");
}

void MeasurePanel::drawConvergence() {
  const ConvergenceCounts all = implicitSteps_.all(), recent = implicitSteps_.recent();
  row("unconverged steps",
      formatted("%llu of %llu", static_cast<unsigned long long>(all.unconvergedSteps),
                static_cast<unsigned long long>(all.steps)),
      "Implicit steps that ended before they converged to solver.tolerance, since the scene was opened. "
      "Set solver.simulation_steps or solver.newton_steps higher.");
  row("last update", formatted("%.2g", all.lastUpdate),
      "The last Newton step's largest change, divided by the largest displacement or by a tenth of the "
      "spacing, whichever is larger. Cloth is at rest when its kinetic energy is low and this is below "
      "0.001.");
  row("iterations a step",
      recent.steps > 0
          ? formatted("%.1f", static_cast<double>(recent.iterations) / static_cast<double>(recent.steps))
          : "-",
      "Iterations of conjugate gradients, over the last second of simulated time.");
}

void MeasurePanel::drawPlots(SelfCollision mode) {
  std::vector<float> times;
  std::vector<Curve> energy{{"kinetic", {0.95f, 0.62f, 0.35f, 1}, {}},
                            {"gravity", theme::accent, {}},
                            {"springs", theme::good, {}}};
  std::vector<Curve> strain{{"max strain", {0.93f, 0.47f, 0.55f, 1}, {}}};
  std::vector<Curve> contacts{{"pairs", theme::alert, {}}};
  for (const Sample& sample : samples_) {
    times.push_back(static_cast<float>(sample.time));
    energy[0].values.push_back(static_cast<float>(sample.energies.kinetic));
    energy[1].values.push_back(static_cast<float>(sample.energies.gravity));
    energy[2].values.push_back(static_cast<float>(sample.energies.springs));
    strain[0].values.push_back(static_cast<float>(100 * sample.energies.maxStrain));
    contacts[0].values.push_back(static_cast<float>(sample.watch.contacts().contacts()));
  }
  drawPlot("energy", times, energy, " J");
  helpTip("Energy over simulated time: kinetic, potential (relative to the start) and stored in springs.");
  drawPlot("strain", times, strain, " %");
  helpTip("The largest stretch of a spring over simulated time.");
  if (mode == SelfCollision::off) return;
  drawPlot("contacts", times, contacts, "");
  helpTip("Pairs of particles of different layers that touch, over simulated time.");
}

void MeasurePanel::saveCurves(const std::filesystem::path& path) const {
  std::string text = "time,kinetic_energy,gravity_energy,spring_energy,max_strain,self_contacts\n";
  for (const Sample& sample : samples_)
    text += formatted("%.9g,%.9g,%.9g,%.9g,%.9g,%llu\n", sample.time, sample.energies.kinetic,
                      sample.energies.gravity, sample.energies.springs, sample.energies.maxStrain,
                      static_cast<unsigned long long>(sample.watch.contacts().contacts()));
  writeFileAtomically(path, text);
}

// Timing uses a solver of its own, since the cloth must stay where it is.
void MeasurePanel::timePasses(Session& session) {
  try {
    Simulation& simulation = session.simulation();
    const std::unique_ptr<Solver> solver = simulation.solverFactory()(
        simulation.solver().backend(), simulation.sharedCloth(), simulation.sharedScene());
    solver->setState(simulation.state());
    passes_ = solver->timePasses(timedSteps);
    passSteps_ = timedSteps;
    passFault_.clear();
  } catch (const Error& error) {
    passFault_ = error.what();
  }
}

void MeasurePanel::drawPasses() {
  if (wideButton("Time the passes of a step")) passesAsked_ = true;
  helpTip("Simulates 60 steps on a copy of the cloth and times each pass.");
  if (!passFault_.empty()) wrappedText(passFault_, theme::alert);
  if (passes_.empty() || !beginRows("passes")) return;
  for (const PassTime& pass : passes_)
    row(pass.name.c_str(), formatted("%.1f \u00b5s", 1e6 * pass.seconds / passSteps_),
        "Time of this pass per step.");
  ImGui::EndTable();
}

void MeasurePanel::drawMemory(const SessionFacts& facts) {
  if (!beginRows("memory")) return;
  row("memory", megabytes(residentBytes()), "Main memory used by the program.");
  row("frames kept",
      formatted("%d in ", facts.newestFrame - facts.oldestFrame + 1) + megabytes(facts.snapshotBytes),
      "Frames you can go back to, and the device memory they use.");
  ImGui::EndTable();
}

bool MeasurePanel::draw(const SessionFacts& facts) {
  drawNumbers(*facts.scene);
  drawPlots(facts.scene->solver.selfCollision);
  const bool saves = wideButton("Save the curves as CSV");
  helpTip("Time, energies, strain and contacts of every sample in these plots.");
  drawPasses();
  drawMemory(facts);
  return saves;
}

}  // namespace clothsim
