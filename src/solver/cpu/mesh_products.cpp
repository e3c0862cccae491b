#include "solver/cpu/mesh_products.h"

#include <algorithm>
#include <map>

#include "solver/cpu/arrays.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/membrane_laws.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/vectors.h"

namespace clothsim::cpu {
namespace {

// What the particles [first, end) of a mesh are corners of.
template <class Real>
void addStretch(MeshStretches<Real>& result, const MeshLists<Real>& lists, std::uint32_t first,
                std::uint32_t end) {
  const auto firstHinge = static_cast<std::uint32_t>(result.coefficients[0].size()),
             firstMembrane = static_cast<std::uint32_t>(result.restSquared[0].size());
  result.stretches.push_back({first, firstHinge, firstMembrane});
  std::map<std::uint32_t, std::uint32_t> own;  // of the stretch, by number
  for (std::uint32_t n = lists.starts[first].hinges; n < lists.starts[end].hinges; ++n)
    own[lists.numbers[n] / 4] = 0;
  for (auto& [number, place] : own) {
    const auto& hinge = lists.hinges[number];
    place = static_cast<std::uint32_t>(result.coefficients[0].size()) - firstHinge;
    for (std::size_t k = 0; k < 4; ++k)
      result.hingeCorners[k].push_back(static_cast<std::int32_t>(hinge.corners[k]));
    for (std::size_t k = 0; k < 3; ++k) result.coefficients[k].push_back(hinge.coefficients[k + 1]);
  }
  for (std::uint32_t n = lists.starts[first].hinges; n < lists.starts[end].hinges; ++n) {
    const std::uint32_t number = lists.numbers[n] / 4;
    result.hingesAt[n] = {own[number], lists.hinges[number].coefficients[lists.numbers[n] % 4]};
  }

  own.clear();
  for (std::uint32_t n = lists.starts[first].membranes; n < lists.starts[end].membranes; ++n)
    own[lists.numbers[n] / 4] = 0;
  for (auto& [number, place] : own) {
    const auto& membrane = lists.membranes[number];
    place = static_cast<std::uint32_t>(result.restSquared[0].size()) - firstMembrane;
    for (std::size_t k = 0; k < 3; ++k) {
      result.membraneCorners[k].push_back(static_cast<std::int32_t>(membrane.corners[k]));
      result.restSquared[k].push_back(membrane.restSquared[k]);
    }
    for (std::size_t k = 0; k < 6; ++k) result.roots[k].push_back(membrane.roots[k]);
  }
  const auto count = static_cast<std::uint32_t>(own.size());
  for (std::uint32_t n = lists.starts[first].membranes; n < lists.starts[end].membranes; ++n)
    result.forcesAt[n - result.firstForce] = lists.numbers[n] % 4 * count + own[lists.numbers[n] / 4];
}

template <class Real>
INLINE Vec3<Real> at(const Arrays<const Real>& field, std::int32_t i) {
  return {field.x[i], field.y[i], field.z[i]};
}

// As the k-th vector of four; the last number means nothing, and with a number of its own the store is one
// that compilers keep in vectors.
template <class Real>
INLINE void putFour(Real* vectors, std::size_t k, Vec3<Real> v) {
  Real* to = vectors + 4 * k;
  to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = v.z;
}
// Where arrays of components have what is of element `first`.
template <class Value, std::size_t size>
INLINE auto from(std::size_t first, std::array<std::vector<Value>, size>& arrays) {
  std::array<Value*, size> result;
  for (std::size_t n = 0; n < size; ++n) result[n] = arrays[n].data() + first;
  return result;
}
template <class Value, std::size_t size>
INLINE auto from(std::size_t first, const std::array<std::vector<Value>, size>& arrays) {
  std::array<const Value*, size> result;
  for (std::size_t n = 0; n < size; ++n) result[n] = arrays[n].data() + first;
  return result;
}

// sum c_j (p_j - p_0) of the hinges from `first` on.
template <class Real>
INLINE void bendHinges(const MeshStretches<Real>& mesh, const Arrays<const Real>& p, std::size_t first,
                       std::size_t count, Real* bent) {
  const auto corners = from(first, mesh.hingeCorners);
  const auto c = from(first, mesh.coefficients);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3<Real> origin = at(p, corners[0][k]);
    putFour(bent, k,
            (c[0][k] * (at(p, corners[1][k]) - origin) + c[1][k] * (at(p, corners[2][k]) - origin)) +
                c[2][k] * (at(p, corners[3][k]) - origin));
  }
}

template <class Real>
using Edges = std::array<Vec3<Real>, 3>;
using Corners = std::array<const std::int32_t*, 3>;
template <class Real>
INLINE Edges<Real> edgesAt(const Corners& corners, std::size_t k, const Arrays<const Real>& field) {
  const Vec3<Real> a = at(field, corners[0][k]), b = at(field, corners[1][k]), c = at(field, corners[2][k]);
  return {c - b, a - c, b - a};
}

template <class Real>
INLINE std::array<Real, 6> rootsAt(const std::array<const Real*, 6>& roots, std::size_t k) {
  return {roots[0][k], roots[1][k], roots[2][k], roots[3][k], roots[4][k], roots[5][k]};
}

template <bool isExact, class Real>
INLINE void findTensions(MeshStretches<Real>& mesh, const Arrays<const Real>& x, std::size_t first,
                         std::size_t count) {
  const auto corners = from(first, std::as_const(mesh.membraneCorners));
  const auto rest = from(first, std::as_const(mesh.restSquared));
  const auto roots = from(first, std::as_const(mesh.roots));
  const auto edges = from(first, mesh.edges);
  const auto tensions = from(first, mesh.tensions);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Edges<Real> d = edgesAt<Real>(corners, k, x);
    const OfEdges<Real> strains = strainsOf<Real>({rest[0][k], rest[1][k], rest[2][k]}, d);
    const std::array<Real, 6> own = rootsAt(roots, k);
    const OfEdges<Real> t = isExact ? timesMatrix(own, strains) : positiveTensions(own, strains);
#pragma GCC unroll 3
    for (std::size_t n = 0; n < 3; ++n) {
      edges[3 * n][k] = d[n].x, edges[3 * n + 1][k] = d[n].y, edges[3 * n + 2][k] = d[n].z;
      tensions[n][k] = t[n];
    }
  }
}

// The forces on the corners of the membranes from `first` on.
template <class Real>
INLINE void pullMembranes(const MeshStretches<Real>& mesh, const Arrays<const Real>& p, std::size_t first,
                          std::size_t count, Real* forces) {
  const auto corners = from(first, mesh.membraneCorners);
  const auto roots = from(first, mesh.roots);
  const auto edges = from(first, mesh.edges);
  const auto t = from(first, mesh.tensions);
  Real *onFirst = forces, *onSecond = forces + 4 * count, *onThird = forces + 8 * count;
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Edges<Real> e = edgesAt<Real>(corners, k, p), d{{{edges[0][k], edges[1][k], edges[2][k]},
                                                           {edges[3][k], edges[4][k], edges[5][k]},
                                                           {edges[6][k], edges[7][k], edges[8][k]}}};
    const OfEdges<Real> more =
        timesMatrix<Real>(rootsAt(roots, k), {dot(d[0], e[0]), dot(d[1], e[1]), dot(d[2], e[2])});
    const Vec3<Real> pullA = t[0][k] * e[0] + more[0] * d[0], pullB = t[1][k] * e[1] + more[1] * d[1],
                     pullC = t[2][k] * e[2] + more[2] * d[2];
    putFour(onFirst, k, pullC - pullB);
    putFour(onSecond, k, pullA - pullC);
    putFour(onThird, k, pullB - pullA);
  }
}

template <class Real>
INLINE auto stretchOf(const ImplicitArguments<Real>& arguments, int row) {
  const Range all = rangeOf(arguments.step.step, row);
  return std::ranges::lower_bound(arguments.own.stretches.stretches, static_cast<std::uint32_t>(all.begin),
                                  {}, &MeshStretches<Real>::Stretch::firstParticle);
}

template <class Real>
INLINE void linearizeMembranesOf(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const auto stretch = stretchOf(arguments, row);
  const std::size_t first = stretch->firstMembrane, count = stretch[1].firstMembrane - first;
  const Arrays<const Real> x = arraysOf(std::as_const(own.iterate.positions));
  own.scalars.hessian == HESSIAN_EXACT ? findTensions<true>(own.stretches, x, first, count)
                                       : findTensions<false>(own.stretches, x, first, count);
}

template <class Real>
INLINE void addProductsOf(const ImplicitArguments<Real>& arguments, int row, Real* scratch) {
  const MeshLists<Real>& lists = arguments.step.lists;
  ImplicitState<Real>& own = arguments.own;
  const MeshStretches<Real>& mesh = own.stretches;
  const Range all = rangeOf(arguments.step.step, row);
  const auto stretch = stretchOf(arguments, row);
  const std::size_t hinges = stretch[1].firstHinge - stretch->firstHinge,
                    membranes = stretch[1].firstMembrane - stretch->firstMembrane;
  Real *bent = scratch, *forces = scratch + 4 * hinges;
  const Arrays<const Real> p = arraysOf(std::as_const(own.directions.positions));
  bendHinges(mesh, p, stretch->firstHinge, hinges, bent);
  pullMembranes(mesh, p, stretch->firstMembrane, membranes, forces);
  const Arrays<Real> products = arraysOf(own.products);
  const auto fourOf = [](const Real* four) { return *reinterpret_cast<const Four<Real>*>(four); };
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const auto &begin = lists.starts[static_cast<std::size_t>(i)],
               &end = lists.starts[static_cast<std::size_t>(i) + 1];
    Four<Real> f{products.x[i], products.y[i], products.z[i], Real(0)};
    for (std::uint32_t n = begin.hinges; n < end.hinges; ++n)
      f = f - mesh.hingesAt[n].coefficient * fourOf(bent + 4 * std::size_t{mesh.hingesAt[n].hinge});
    for (std::uint32_t n = begin.membranes - mesh.firstForce; n < end.membranes - mesh.firstForce; ++n)
      f = f + fourOf(forces + 4 * std::size_t{mesh.forcesAt[n]});
    put(products, i, threeOf(f));
  }
}

template <class Real>
struct alignas(4 * sizeof(Real)) FourNumbers {
  Real numbers[4];
};
// Room for what the elements of a stretch come to, of a thread.
template <class Real>
Real* scratchFor(const ImplicitArguments<Real>& arguments) {
  static thread_local std::vector<FourNumbers<Real>> room;
  room.resize(std::max({room.size(), std::size_t{arguments.own.stretches.mostFours}, std::size_t{1}}));
  return room.data()->numbers;
}

}  // namespace

template <class Real>
MeshStretches<Real> makeMeshStretches(const Cloth& cloth, const MeshLists<Real>& lists) {
  MeshStretches<Real> result;
  if (lists.empty()) return result;
  result.firstForce = lists.starts.front().membranes;
  result.hingesAt.resize(lists.starts.front().triangles);
  result.forcesAt.resize(lists.numbers.size() - result.firstForce);
  for (const Piece& piece : cloth.pieces())
    for (int row = 0; piece.isMesh && row < rowsOf(piece); ++row) {
      const auto first = piece.firstParticle + static_cast<std::uint32_t>(MESH_ROW * row),
                 end = piece.firstParticle + static_cast<std::uint32_t>(piece.columns);
      addStretch(result, lists, first, std::min(first + MESH_ROW, end));
      const auto& stretch = result.stretches.back();
      const std::size_t hinges = result.coefficients[0].size() - stretch.firstHinge,
                        membranes = result.restSquared[0].size() - stretch.firstMembrane;
      result.mostFours = std::max(result.mostFours, static_cast<std::uint32_t>(hinges + 3 * membranes));
    }
  result.stretches.push_back({static_cast<std::uint32_t>(cloth.particleCount()),
                              static_cast<std::uint32_t>(result.coefficients[0].size()),
                              static_cast<std::uint32_t>(result.restSquared[0].size())});
  for (std::vector<Real>& edge : result.edges) edge.resize(result.restSquared[0].size());
  for (std::vector<Real>& tension : result.tensions) tension.resize(result.restSquared[0].size());
  return result;
}
template MeshStretches<float> makeMeshStretches(const Cloth&, const MeshLists<float>&);
template MeshStretches<double> makeMeshStretches(const Cloth&, const MeshLists<double>&);

VECTOR_CLONES(void, linearizeMembranes, (const ImplicitArguments<float>& arguments, int row),
              (arguments, row), linearizeMembranesOf(arguments, row))
void linearizeMembranes(const ImplicitArguments<double>& arguments, int row) {
  linearizeMembranesOf(arguments, row);
}

namespace {

VECTOR_CLONES(void, addProducts, (const ImplicitArguments<float>& arguments, int row, float* scratch),
              (arguments, row, scratch), addProductsOf(arguments, row, scratch))

}  // namespace

void addElementProducts(const ImplicitArguments<float>& arguments, int row) {
  addProducts(arguments, row, scratchFor(arguments));
}
void addElementProducts(const ImplicitArguments<double>& arguments, int row) {
  addProductsOf(arguments, row, scratchFor(arguments));
}

}  // namespace clothsim::cpu
