#include "solver/cpu/mesh_implicit.h"

#include "solver/cpu/arrays.h"
#include "solver/cpu/implicit_laws.h"
#include "solver/cpu/membrane_laws.h"
#include "solver/cpu/mesh_elements.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// Calls visit(spring, d, limitLength) for the springs of particle i in ascending number, d from it to the
// other end; not for those that do nothing.
template <class Real, class Visit>
void forEachSpring(const ImplicitArguments<Real>& arguments, std::size_t i, Visit visit) {
  const MeshLists<Real>& lists = arguments.step.lists;
  const Components<Real>& x = arguments.own.iterate.positions;
  for (std::uint32_t n = lists.starts[i].springs; n < lists.starts[i + 1].springs; ++n) {
    const auto& spring = lists.springs[n];
    if (spring.stiffness == Real(0) && arguments.step.step.limitStiffness == Real(0)) continue;
    visit(spring, at(x, spring.other) - at(x, static_cast<std::ptrdiff_t>(i)),
          arguments.step.step.limitFactor * spring.restLength);
  }
}

// sum c_j (v_j - v_0), the c of a hinge summing to 0
template <class Real>
Vec3<Real> bentOf(const typename MeshLists<Real>::HingeParams& hinge, const Components<Real>& v) {
  const Vec3<Real> origin = at(v, hinge.corners[0]);
  const Vec3<Real> b = hinge.coefficients[1] * (at(v, hinge.corners[1]) - origin);
  const Vec3<Real> p = hinge.coefficients[2] * (at(v, hinge.corners[2]) - origin);
  const Vec3<Real> q = hinge.coefficients[3] * (at(v, hinge.corners[3]) - origin);
  return (b + p) + q;
}

// Calls visit(hinge, corner) for the hinges of particle i.
template <class Real, class Visit>
void forEachHinge(const ImplicitArguments<Real>& arguments, std::size_t i, Visit visit) {
  const MeshLists<Real>& lists = arguments.step.lists;
  for (std::uint32_t n = lists.starts[i].hinges; n < lists.starts[i + 1].hinges; ++n)
    visit(lists.hinges[lists.numbers[n] / 4], lists.numbers[n] % 4);
}

// Calls visit(membrane, corner, d) for the membranes of particle i, d their edges.
template <class Real, class Visit>
void forEachMembrane(const ImplicitArguments<Real>& arguments, std::size_t i, Visit visit) {
  const MeshLists<Real>& lists = arguments.step.lists;
  for (std::uint32_t n = lists.starts[i].membranes; n < lists.starts[i + 1].membranes; ++n) {
    const auto& membrane = lists.membranes[lists.numbers[n] / 4];
    visit(membrane, lists.numbers[n] % 4, edgesOf(membrane.corners, arguments.own.iterate.positions));
  }
}

// The tensions of the edges that meet at a corner, and of each row of R the force there.
template <class Real>
Symmetric<Real> blockOf(const typename MeshLists<Real>::MembraneParams& membrane, std::uint32_t corner,
                        const std::array<Vec3<Real>, 3>& d) {
  const OfEdges<Real> t = positiveTensions(membrane.roots, strainsOf(membrane.restSquared, d));
  const std::size_t next = corner == 2 ? 0 : corner + 1, last = corner == 0 ? 2 : corner - 1;
  const Real across = t[last] + t[next];
  Symmetric<Real> block{{across, across, across}, {}};
  const auto& [xx, xy, xz, yy, yz, zz] = membrane.roots;
  const Vec3<Real> none{};
  block = block + outerProduct(Real(1), pullAt<Real>(corner, {xx * d[0], xy * d[1], xz * d[2]}));
  block = block + outerProduct(Real(1), pullAt<Real>(corner, {none, yy * d[1], yz * d[2]}));
  return block + outerProduct(Real(1), pullAt<Real>(corner, {none, none, zz * d[2]}));
}

// How a membrane's energy changes as e does.
template <class Real>
Real membraneChange(const std::array<Real, 6>& roots, const OfEdges<Real>& before,
                    const OfEdges<Real>& change) {
  const OfEdges<Real> w = timesRoots(roots, before), dw = timesRoots(roots, change);
  OfEdges<Real> part;
  for (std::size_t k = 0; k < 3; ++k) part[k] = dw[k] * (w[k] + Real(0.5) * dw[k]);
  return (part[0] + part[1]) + part[2];
}

template <class Real>
void addMembraneTrials(const ImplicitArguments<Real>& arguments, std::size_t i) {
  ImplicitState<Real>& own = arguments.own;
  forEachMembrane(arguments, i, [&](const auto& membrane, std::uint32_t corner, const auto& d) {
    if (corner != 0) return;
    const auto more = edgesOf(membrane.corners, own.increments);
    const OfEdges<Real> before = strainsOf(membrane.restSquared, d);
    forEachLength(own, [&](Real* trial, Real l) {
      OfEdges<Real> change;
      for (std::size_t n = 0; n < 3; ++n)
        change[n] = l * (dot(d[n], more[n]) + (Real(0.5) * l) * dot(more[n], more[n]));
      trial[i] = trial[i] + membraneChange(membrane.roots, before, change);
    });
  });
}

}  // namespace

template <class Real>
void addMeshBlocks(const ImplicitArguments<Real>& arguments, int row) {
  const Range all = rangeOf(arguments.step.step, row);
  for (std::ptrdiff_t n = all.begin; n < all.end; ++n) {
    const auto i = static_cast<std::size_t>(n);
    Symmetric<Real> block = at(arguments.own.factors, n);
    forEachSpring(arguments, i, [&](const auto& spring, Vec3<Real> d, Real limitLength) {
      const auto [across, along] = springBlock(d, spring.stiffness, spring.restLength,
                                               arguments.step.step.limitStiffness, limitLength);
      Symmetric<Real> k = outerProduct(along, d);
      k.diagonal = k.diagonal + Vec3<Real>{across, across, across};
      block = block + k;
    });
    forEachHinge(arguments, i, [&](const auto& hinge, std::uint32_t corner) {
      const Real b = hinge.coefficients[corner] * hinge.coefficients[corner];
      block.diagonal = block.diagonal + Vec3<Real>{b, b, b};
    });
    forEachMembrane(arguments, i, [&](const auto& membrane, std::uint32_t corner, const auto& d) {
      block = block + blockOf<Real>(membrane, corner, d);
    });
    put(arguments.own.factors, n, block);
  }
}

// Springs first, as in the forces.
template <class Real>
void addMeshProducts(const ImplicitArguments<Real>& arguments, int row) {
  const Range all = rangeOf(arguments.step.step, row);
  const Components<Real>& p = arguments.own.directions.positions;
  Components<Real>& products = arguments.own.products;
  const bool isExact = arguments.own.scalars.hessian == HESSIAN_EXACT,
             hasSprings = stretchOf(arguments.step, row)->hasStiffSprings ||
                          arguments.step.step.limitStiffness > Real(0);
  for (std::ptrdiff_t n = all.begin; n < all.end; ++n) {
    const auto i = static_cast<std::size_t>(n);
    Vec3<Real> f{};
    if (hasSprings)
      forEachSpring(arguments, i, [&](const auto& spring, Vec3<Real> d, Real limitLength) {
        const auto [across, along] = springBlock(d, spring.stiffness, spring.restLength,
                                                 arguments.step.step.limitStiffness, limitLength, isExact);
        const Vec3<Real> e = at(p, spring.other) - at(p, static_cast<std::ptrdiff_t>(i));
        f = f + (across * e + (along * dot(d, e)) * d);
      });
    products.x[i] = f.x;
    products.y[i] = f.y;
    products.z[i] = f.z;
  }
  addElementProducts(arguments, row);
}

// A spring belongs to its end of the larger index, a hinge or a membrane to its first corner.
template <class Real>
void addMeshTrials(const ImplicitArguments<Real>& arguments, int row) {
  const Range all = rangeOf(arguments.step.step, row);
  ImplicitState<Real>& own = arguments.own;
  for (std::ptrdiff_t n = all.begin; n < all.end; ++n) {
    const auto i = static_cast<std::size_t>(n);
    forEachSpring(arguments, i, [&](const auto& spring, Vec3<Real> d, Real limitLength) {
      if (spring.other > i) return;
      const Vec3<Real> e =
          at(own.increments, spring.other) - at(own.increments, static_cast<std::ptrdiff_t>(i));
      forEachLength(own, [&](Real* trial, Real l) {
        trial[i] = trial[i] + springChange(d, e, l, spring.stiffness, spring.restLength,
                                           arguments.step.step.limitStiffness, limitLength);
      });
    });
    forEachHinge(arguments, i, [&](const auto& hinge, std::uint32_t corner) {
      if (corner != 0) return;
      const Vec3<Real> bent = bentOf<Real>(hinge, own.iterate.positions),
                       more = bentOf<Real>(hinge, own.increments);
      const Real first = dot(bent, more), second = dot(more, more);
      forEachLength(
          own, [&](Real* trial, Real l) { trial[i] = trial[i] + l * (first + (Real(0.5) * l) * second); });
    });
    addMembraneTrials(arguments, i);
  }
}

template void addMeshBlocks(const ImplicitArguments<float>&, int);
template void addMeshBlocks(const ImplicitArguments<double>&, int);
template void addMeshProducts(const ImplicitArguments<float>&, int);
template void addMeshProducts(const ImplicitArguments<double>&, int);
template void addMeshTrials(const ImplicitArguments<float>&, int);
template void addMeshTrials(const ImplicitArguments<double>&, int);

}  // namespace clothsim::cpu
