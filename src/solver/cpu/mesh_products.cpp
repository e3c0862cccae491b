#include "solver/cpu/mesh_products.h"

#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/membrane_laws.h"
#include "solver/cpu/mesh_elements.h"

namespace clothsim::cpu {
namespace {

template <bool isExact, class Real>
INLINE void findTensions(const MeshStretches<Real>& mesh, MembraneTensions<Real>& membranes,
                         const Real* vertices, std::size_t first, std::size_t count) {
  forSomeMembranes(
      mesh, vertices, first, count,
      [&](std::size_t begin, std::size_t some, const SomeCorners<Real>& corners)
          __attribute__((always_inline)) {
            const auto rest = from(first + begin, mesh.restSquared);
            const auto roots = from(first + begin, mesh.roots);
            const auto edges = from(first + begin, membranes.edges);
            const auto tensions = from(first + begin, membranes.tensions);
#pragma GCC ivdep
            for (std::size_t k = 0; k < some; ++k) {
              const Edges<Real> d = corners.edgesAt(k);
              const OfEdges<Real> strains = strainsOf<Real>({rest[0][k], rest[1][k], rest[2][k]}, d);
              const std::array<Real, 6> own = rootsAt(roots, k);
              const OfEdges<Real> t = isExact ? timesMatrix(own, strains) : positiveTensions(own, strains);
#pragma GCC unroll 3
              for (std::size_t n = 0; n < 3; ++n) {
                edges[3 * n][k] = d[n].x, edges[3 * n + 1][k] = d[n].y, edges[3 * n + 2][k] = d[n].z;
                tensions[n][k] = t[n];
              }
            }
          });
}

// The forces on the corners of the membranes from `first` on.
template <class Real>
INLINE void pullMembranes(const MeshStretches<Real>& mesh, const MembraneTensions<Real>& membranes,
                          const Real* vertices, std::size_t first, std::size_t count, Real* forces) {
  forSomeMembranes(
      mesh, vertices, first, count,
      [&](std::size_t begin, std::size_t some, const SomeCorners<Real>& corners)
          __attribute__((always_inline)) {
            const auto roots = from(first + begin, mesh.roots);
            const auto edges = from(first + begin, membranes.edges);
            const auto t = from(first + begin, membranes.tensions);
#pragma GCC ivdep
            for (std::size_t k = 0; k < some; ++k) {
              const Edges<Real> e = corners.edgesAt(k), d{{{edges[0][k], edges[1][k], edges[2][k]},
                                                           {edges[3][k], edges[4][k], edges[5][k]},
                                                           {edges[6][k], edges[7][k], edges[8][k]}}};
              const OfEdges<Real> more =
                  timesMatrix<Real>(rootsAt(roots, k), {dot(d[0], e[0]), dot(d[1], e[1]), dot(d[2], e[2])});
              const Vec3<Real> pullA = t[0][k] * e[0] + more[0] * d[0],
                               pullB = t[1][k] * e[1] + more[1] * d[1],
                               pullC = t[2][k] * e[2] + more[2] * d[2];
              putPulls(forces, count, begin + k, pullA, pullB, pullC);
            }
          });
}

template <class Real>
INLINE void linearizeMembranesOf(const ImplicitArguments<Real>& arguments, int row, Real* vertices) {
  ImplicitState<Real>& own = arguments.own;
  const MeshStretches<Real>& mesh = arguments.step.stretches;
  const auto stretch = stretchOf(arguments.step, row);
  const std::size_t first = stretch->firstMembrane, count = stretch[1].firstMembrane - first;
  putVertices(mesh, *stretch, stretch[1].firstVertex, arraysOf(std::as_const(own.iterate.positions)),
              vertices);
  own.scalars.hessian == HESSIAN_EXACT ? findTensions<true>(mesh, own.membranes, vertices, first, count)
                                       : findTensions<false>(mesh, own.membranes, vertices, first, count);
}

template <class Real>
INLINE void addProductsOf(const ImplicitArguments<Real>& arguments, int row, Real* scratch) {
  ImplicitState<Real>& own = arguments.own;
  const MeshStretches<Real>& mesh = arguments.step.stretches;
  const auto stretch = stretchOf(arguments.step, row);
  const ElementsOfStretch<Real> elements(*stretch, stretch[1], scratch);
  putVertices(mesh, *stretch, stretch[1].firstVertex, arraysOf(std::as_const(own.directions.positions)),
              elements.vertices);
  bendHinges(mesh, elements.vertices, stretch->firstHinge, elements.hinges, elements.bent);
  pullMembranes(mesh, own.membranes, elements.vertices, stretch->firstMembrane, elements.membranes,
                elements.pulls);
  const Arrays<Real> products = arraysOf(own.products);
  const Range all = rangeOf(arguments.step.step, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Four<Real> f{products.x[i], products.y[i], products.z[i], Real(0)};
    put(products, i, threeOf(withElements(arguments.step, elements, i, f)));
  }
}

}  // namespace

template <class Real>
void MembraneTensions<Real>::resize(std::size_t membranes) {
  for (std::vector<Real>& edge : edges) edge.resize(membranes);
  for (std::vector<Real>& tension : tensions) tension.resize(membranes);
}
template struct MembraneTensions<float>;
template struct MembraneTensions<double>;

namespace {

VECTOR_CLONES(void, linearizeFloat, (const ImplicitArguments<float>& arguments, int row, float* vertices),
              (arguments, row, vertices), linearizeMembranesOf(arguments, row, vertices))
VECTOR_CLONES(void, addProducts, (const ImplicitArguments<float>& arguments, int row, float* scratch),
              (arguments, row, scratch), addProductsOf(arguments, row, scratch))

}  // namespace

void linearizeMembranes(const ImplicitArguments<float>& arguments, int row) {
  linearizeFloat(arguments, row, scratchFor(arguments.step.stretches));
}
void linearizeMembranes(const ImplicitArguments<double>& arguments, int row) {
  linearizeMembranesOf(arguments, row, scratchFor(arguments.step.stretches));
}
void addElementProducts(const ImplicitArguments<float>& arguments, int row) {
  addProducts(arguments, row, scratchFor(arguments.step.stretches));
}
void addElementProducts(const ImplicitArguments<double>& arguments, int row) {
  addProductsOf(arguments, row, scratchFor(arguments.step.stretches));
}

}  // namespace clothsim::cpu
