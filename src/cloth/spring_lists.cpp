#include "cloth/spring_lists.h"

#include <algorithm>
#include <cstddef>

namespace clothsim {
namespace {

// `visit(element, add)` calls add(particle, entry) for every particle of an element, with entries ascending.
template <class Elements, class Visit>
SpringLists::Incidence incidenceOf(const Elements& elements, std::uint32_t particles, Visit visit) {
  SpringLists::Incidence result;
  result.starts.assign(std::size_t{particles} + 1, 0);
  const auto forAll = [&](auto add) {
    for (std::uint32_t n = 0; n < elements.size(); ++n) visit(n, add);
  };
  forAll([&](std::uint32_t particle, std::uint32_t) { ++result.starts[particle + 1]; });
  for (std::size_t i = 0; i < particles; ++i) result.starts[i + 1] += result.starts[i];
  result.entries.resize(result.starts.back());
  std::vector<std::uint32_t> next(result.starts.begin(), result.starts.end() - 1);
  forAll([&](std::uint32_t particle, std::uint32_t entry) { result.entries[next[particle]++] = entry; });
  return result;
}

}  // namespace

std::optional<std::uint32_t> SpringLists::edgeBetween(std::uint32_t i, std::uint32_t j) const {
  for (std::uint32_t at = springsOf.starts[i]; at < springsOf.starts[i + 1]; ++at) {
    const MeshSpring& spring = springs[springsOf.entries[at]];
    if (spring.kind == SpringKind::structural && (spring.a == j || spring.b == j))
      return springsOf.entries[at];
  }
  return std::nullopt;
}

void gatherIncidences(SpringLists& lists, std::uint32_t particles) {
  lists.springsOf = incidenceOf(lists.springs, particles, [&](std::uint32_t n, auto add) {
    add(lists.springs[n].a, n);
    add(lists.springs[n].b, n);
  });
  lists.hingesOf = incidenceOf(lists.hinges, particles, [&](std::uint32_t n, auto add) {
    for (std::uint32_t k = 0; k < 4; ++k) add(lists.hinges[n].corners[k], 4 * n + k);
  });
  lists.trianglesOf = incidenceOf(lists.triangles, particles, [&](std::uint32_t n, auto add) {
    for (const std::uint32_t corner : lists.triangles[n]) add(corner, n);
  });
  lists.membranesOf = incidenceOf(lists.membranes, particles, [&](std::uint32_t n, auto add) {
    for (std::uint32_t k = 0; k < 3; ++k) add(lists.membranes[n].corners[k], 4 * n + k);
  });
}

std::vector<SpringColor> colorSprings(std::vector<MeshSpring>& springs, std::size_t first,
                                      std::uint32_t particles) {
  struct Colored {
    SpringKind kind;
    std::uint32_t color;
    MeshSpring spring;
  };
  std::vector<Colored> colored;
  for (const SpringKind kind : {SpringKind::structural, SpringKind::bending}) {
    std::vector<std::vector<bool>> taken;  // by colour and particle
    for (std::size_t n = first; n < springs.size(); ++n) {
      const MeshSpring& spring = springs[n];
      if (spring.kind != kind) continue;
      std::uint32_t color = 0;
      while (color < taken.size() && (taken[color][spring.a] || taken[color][spring.b])) ++color;
      if (color == taken.size()) taken.emplace_back(particles);
      taken[color][spring.a] = taken[color][spring.b] = true;
      colored.push_back({kind, color, spring});
    }
  }
  std::stable_sort(colored.begin(), colored.end(), [](const Colored& x, const Colored& y) {
    return x.kind != y.kind ? x.kind < y.kind : x.color < y.color;
  });
  std::vector<SpringColor> colors;
  for (std::size_t k = 0; k < colored.size(); ++k) {
    const auto number = static_cast<std::uint32_t>(first + k);
    springs[number] = colored[k].spring;
    if (k == 0 || colored[k].kind != colored[k - 1].kind || colored[k].color != colored[k - 1].color)
      colors.push_back({number, number});
    colors.back().end = number + 1;
  }
  return colors;
}

}  // namespace clothsim
