// Self-collision on the CPU: the twin of shaders/sim/self/*.comp (what and why: solver/self_collision.h).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "cloth/seam_neighbours.h"
#include "solver/cpu/contact_blocks.h"
#include "solver/cpu/cpu_state.h"
#include "solver/cpu/tile_search.h"
#include "solver/cpu/vectors.h"
#include "solver/executor.h"
#include "solver/self_collision.h"

namespace clothsim::cpu {

template <class Real>
class SelfCollision {
 public:
  // `cloth` must outlive it.
  explicit SelfCollision(const Cloth& cloth);

  void configure(const Scene& scene);
  [[nodiscard]] bool isOn() const { return mode_ != clothsim::SelfCollision::off; }
  [[nodiscard]] bool isRobust() const { return mode_ == clothsim::SelfCollision::robust; }

  // Does a pass of Domain::contacts. Building the hash and finding candidates, and clamping, are skipped in
  // steps in which the checks before them have found that there is no need.
  void run(PassCall call, const CpuState<Real>& before, CpuState<Real>& after,
           const std::vector<Real>& inverseMasses);
  void setCuts(const Cuts& cuts);
  // For a new state: forgets the hash.
  void restart() { isStale_ = true; }

  [[nodiscard]] ContactCounts counts() const { return counts_; }
  void forgetCounts() { counts_ = {}; }
  // Memory whose content nobody needs between steps; in a step it changes places with the positions.
  [[nodiscard]] Components<Real>& unusedPositions() { return moved_; }

  // For tests: builds the hash for these positions and returns all pairs (i, candidate of i) that the passes
  // would look at.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> candidatePairs(
      const Components<Real>& positions);

 private:
  // A candidate, and whose it is.
  struct Candidate {
    std::uint32_t of, candidate;
  };

  // Whether some pairs have distances of their own.
  [[nodiscard]] bool usesNearCodes() const { return hasNearCodes_ || !cutMasks_.empty(); }
  // The candidate (shared/self_collision.h), or EXCLUDED for a pair that is left to its springs.
  [[nodiscard]] std::uint32_t encode(std::uint32_t piece, std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] std::uint32_t encodeOnMesh(std::uint32_t i, std::uint32_t j) const;  // of one mesh
  void checkHash(const CpuState<Real>& before, const CpuState<Real>& after);
  // Takes the positions of the state for those that candidates are near at, and its motion for the one that
  // needs no new search.
  void buildHash(const CpuState<Real>& state);
  void findCandidates();
  // Those of a tile, from what lies near it; what its particles have no slots for goes to `overflow`.
  void setCandidates(std::uint32_t tile, std::span<const NearTile> found, std::vector<Candidate>& overflow);
  // Of the particles [begin, end).
  [[nodiscard]] std::span<const Candidate> overflowOf(std::uint32_t begin, std::uint32_t end) const;
  std::uint32_t& candidateAt(std::uint32_t slot, std::uint32_t particle) {
    return candidates_[slot * static_cast<std::size_t>(params_.particles) + particle];
  }
  void addLatticePlaces(const Piece& piece);
  // Pushes particles apart that are too near.
  void resolveContacts(const CpuState<Real>& before, CpuState<Real>& after,
                       const std::vector<Real>& inverseMasses);
  // Whether some pair of non-adjacent particles has come nearer than D: needsClamp_.
  void checkMotion(const CpuState<Real>& before, const CpuState<Real>& after,
                   const std::vector<Real>& inverseMasses);
  // Shortens the motion of the step, pair by pair, until none has. Each of two may cover half of the distance
  // that is left between them, so they cannot meet.
  void clampMotion(const CpuState<Real>& before, CpuState<Real>& after,
                   const std::vector<Real>& inverseMasses);
  template <class Work>
  void forEachBlock(Work work);
  // work(particles) for stretches of all particles, on all threads.
  template <class Work>
  void forEachRange(Work work);

  const Cloth* cloth_;
  SeamNeighbours seamNeighbours_;
  clothsim::SelfCollision mode_ = clothsim::SelfCollision::off;
  SelfParams<Real> params_{};
  std::vector<Real> distances_;
  std::vector<Vec3<Real>> places_;  // at rest [m]; empty without meshes
  LatticePlaces<Real> lattice_;
  TileSearch<Real> tiles_;
  Cuts cuts_;
  std::vector<std::uint32_t> cutMasks_;  // makeCutMasks(); empty: none
  bool hasNearCodes_ = false;
  bool isStale_ = true;     // the hash no longer serves
  bool isRebuilt_ = false;  // by the last buildHash()
  bool needsClamp_ = false;
  ContactCounts counts_;

  std::vector<FourNumbers<Real>> fours_;  // the positions that contacts are looked for at (putFours())
  Components<Real> hashedPositions_, moved_;
  RigidMotion hashedMotion_;  // of the cloth when it was hashed
  double stepsSinceHash_ = 0;
  std::vector<std::uint32_t> candidates_;      // slot-major
  std::vector<std::uint8_t> candidateCounts_;  // that have slots
  std::vector<Candidate> overflow_;            // by particle
  std::vector<Block> blocks_;
};

extern template class SelfCollision<float>;
extern template class SelfCollision<double>;

}  // namespace clothsim::cpu
