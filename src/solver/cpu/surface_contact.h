// Contact of the cloth's surface with itself on the CPU: the twin of shaders/sim/surface/*.comp (what and
// why: solver/surface.h).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/cpu/cpu_state.h"
#include "solver/cpu/flat_blocks.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/near_parts.h"
#include "solver/cpu/surface_search.h"
#include "solver/executor.h"
#include "solver/surface.h"

namespace clothsim::cpu {

template <class Real>
class SurfaceContact {
 public:
  void setSurface(ClothSurface<Real> surface) {
    surface_ = std::move(surface);
    nearParts_.clear();
  }

  // Does a pass of Domain::surface.
  void run(PassCall call, const CpuState<Real>& before, CpuState<Real>& after, ImplicitState<Real>& implicit,
           const PassArguments<Real>& arguments, const std::vector<Real>& inverseMasses);
  [[nodiscard]] ContactCounts counts() const { return countsOf(state_); }
  void forgetCounts() { clothsim::forgetCounts(state_); }

 private:
  // Two parts across the way on which they are nearest: where their particles are along it, from the first
  // one on, and how far they move.
  struct Sides {
    Real places[4], motions[4];
    Real first, second;  // the places of each part that are nearest to the other
  };

  // What pairs that are too near want of a particle, in quanta, and with what weight.
  struct Correction {
    std::int32_t x, y, z, weight;
  };

  void boxParticles(const Components<Real>& starts, Real around);
  void listNear(const Components<Real>& starts, Real around);
  void findFlat(const Components<Real>& starts, const Components<Real>& ends, Real reach);
  [[nodiscard]] Real leftOf(Real distance, const Parts& parts) const;
  template <bool looksAtFlat, class Test>
  void forEachPair(std::uint32_t triangle, const Components<Real>& starts, Real reach, Test test);
  void findTouching(const CpuState<Real>& before, ImplicitState<Real>& implicit,
                    const PassArguments<Real>& arguments);
  void settle(const CpuState<Real>& before, const CpuState<Real>& after, ImplicitState<Real>& implicit);
  // From where the motion of this round begins.
  [[nodiscard]] const Components<Real>& startsOf(const CpuState<Real>& before) const {
    return state_.isLater != 0 ? safePositions_ : before.positions;
  }
  [[nodiscard]] Sides sidesOf(const Parts& parts, Vec3<Real> way, const Components<Real>& starts) const;
  [[nodiscard]] static Real widthOf(const Sides& sides) { return sides.first - sides.second; }
  [[nodiscard]] bool isTooNear(const Parts& parts, const Sides& sides, Real least) const;
  [[nodiscard]] bool turnsTooNear(const Parts& parts, Vec3<Real> way, const Components<Real>& starts,
                                  Real least) const;
  [[nodiscard]] Vec3<Real> acrossBoth(const Parts& parts, Vec3<Real> way,
                                      const Components<Real>& starts) const;
  void keepToSides(const Parts& parts, const Sides& sides);
  void pushApart(const Parts& parts, Vec3<Real> way, const Components<Real>& ends, Real least,
                 const std::vector<Real>& inverseMasses);
  void correct(CpuState<Real>& after, const StepParams<Real>& step, const std::vector<Real>& inverseMasses);
  void guard(const CpuState<Real>& before, CpuState<Real>& after, const StepParams<Real>& step,
             const std::vector<Real>& inverseMasses, std::uint32_t round);
  void shorten(const CpuState<Real>& before, CpuState<Real>& after, const StepParams<Real>& step,
               const std::vector<Real>& inverseMasses);

  ClothSurface<Real> surface_;
  SurfaceState state_ = freshSurfaceState();
  SurfaceBoxes<Real> boxes_;
  NearParts<Real> nearParts_;
  FlatBlocks<Real> flatBlocks_;
  Components<Real> motions_;  // of this round
  Components<Real> safePositions_, safeVelocities_;
  std::vector<std::vector<SurfacePair<Real>>> foundPairs_;  // by chunk of triangles
  std::vector<Correction> corrections_;
  std::vector<Real> kept_, newlyKept_;  // how much of its motion each particle keeps
};

extern template class SurfaceContact<float>;
extern template class SurfaceContact<double>;

}  // namespace clothsim::cpu
