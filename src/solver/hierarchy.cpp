#include "solver/hierarchy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "cloth/cuts.h"

namespace clothsim {
namespace {

constexpr std::uint32_t NONE = 0xffffffffu;

// Lists of numbers, one behind the other: those of entry i are [starts[i], starts[i + 1]).
struct Lists {
  std::vector<std::uint32_t> starts{0}, entries;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(starts.size() - 1); }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t i) const {
    return std::span(entries).subspan(starts[i], starts[i + 1] - starts[i]);
  }
  void closeEntry() { starts.push_back(static_cast<std::uint32_t>(entries.size())); }
};

template <class Visit>
void forEachSpringOf(const SpringLists& lists, const Piece& piece, std::uint32_t i, std::uint32_t cutMask,
                     Visit visit) {
  if (piece.isMesh) {
    for (std::uint32_t n = lists.springsOf.starts[i]; n < lists.springsOf.starts[i + 1]; ++n) {
      const MeshSpring& spring = lists.springs[lists.springsOf.entries[n]];
      visit(spring.a == i ? spring.b : spring.a, spring.kind == SpringKind::structural);
    }
    return;
  }
  const auto columns = static_cast<std::uint32_t>(piece.columns);
  const int column = static_cast<int>((i - piece.firstParticle) % columns),
            row = static_cast<int>((i - piece.firstParticle) / columns);
  for (std::uint32_t k = 0; k < incidentSprings.size(); ++k) {
    const IncidentSpring& spring = incidentSprings[k];
    const int otherColumn = column + spring.columns, otherRow = row + spring.rows;
    if (!piece.slotEnabled[spring.slot] || (cutMask >> k & 1u) != 0 || !piece.contains(otherColumn, otherRow))
      continue;
    visit(piece.particle(otherColumn, otherRow), std::abs(spring.columns) < 2 && std::abs(spring.rows) < 2);
  }
}

// The neighbours of each particle of a piece, numbered from its first one.
Lists springGraph(const SpringLists& lists, const Piece& piece, const std::vector<std::uint32_t>& cutMasks) {
  Lists graph;
  for (std::uint32_t i = piece.firstParticle; i < piece.firstParticle + piece.particleCount(); ++i) {
    forEachSpringOf(lists, piece, i, cutMasks.empty() ? 0 : cutMasks[i],
                    [&](std::uint32_t other, bool isNear) {
                      if (isNear) graph.entries.push_back(other - piece.firstParticle);
                    });
    graph.closeEntry();
  }
  return graph;
}

// The particles that the elements of particle i have: its own, the other ends of the springs that it owns,
// and the ends of the lines of bending that it is in the middle of; of a mesh its springs to smaller numbers,
// and the hinges and membranes whose first corner it is.
template <class Visit>
void forEachElementParticle(const SpringLists& lists, const Piece& piece, std::uint32_t i, Visit visit) {
  visit(i);
  forEachSpringOf(lists, piece, i, 0, [&](std::uint32_t other, bool) {
    if (other < i) visit(other);
  });
  if (piece.isMesh) {
    for (std::uint32_t n = lists.hingesOf.starts[i]; n < lists.hingesOf.starts[i + 1]; ++n)
      if (lists.hingesOf.entries[n] % 4 == 0)
        for (const std::uint32_t corner : lists.hinges[lists.hingesOf.entries[n] / 4].corners) visit(corner);
    for (std::uint32_t n = lists.membranesOf.starts[i]; n < lists.membranesOf.starts[i + 1]; ++n)
      if (lists.membranesOf.entries[n] % 4 == 0)
        for (const std::uint32_t corner : lists.membranes[lists.membranesOf.entries[n] / 4].corners)
          visit(corner);
    return;
  }
  if (!piece.hasMaterial) return;
  const auto columns = static_cast<std::uint32_t>(piece.columns);
  const std::uint32_t place = i - piece.firstParticle, column = place % columns, row = place / columns;
  if (column > 0 && column + 1 < columns) visit(i - 1), visit(i + 1);
  if (row > 0 && row + 1 < static_cast<std::uint32_t>(piece.rows)) visit(i - columns), visit(i + columns);
}

// Of each vertex of a graph the connected part that it is in, ascending.
std::vector<std::uint32_t> partsOf(const Lists& graph) {
  std::vector<std::uint32_t> parts(graph.count(), NONE), waiting;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < graph.count(); ++first) {
    if (parts[first] != NONE) continue;
    parts[first] = count;
    waiting.assign(1, first);
    while (!waiting.empty()) {
      const std::uint32_t i = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t other : graph[i]) {
        if (parts[other] != NONE) continue;
        parts[other] = count;
        waiting.push_back(other);
      }
    }
    ++count;
  }
  return parts;
}

std::uint32_t largestPart(const std::vector<std::uint32_t>& parts) {
  std::vector<std::uint32_t> sizes(parts.size());
  std::uint32_t largest = 0;
  for (const std::uint32_t part : parts) largest = std::max(largest, ++sizes[part]);
  return largest;
}

// Of each vertex the aggregate that it is in.
struct Aggregates {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};

Aggregates aggregate(const Lists& graph) {
  Aggregates aggregates{std::vector<std::uint32_t>(graph.count(), NONE)};
  for (std::uint32_t i = 0; i < graph.count(); ++i) {
    const auto isFree = [&](std::uint32_t vertex) { return aggregates.of[vertex] == NONE; };
    if (!isFree(i) || !std::all_of(graph[i].begin(), graph[i].end(), isFree)) continue;
    aggregates.of[i] = aggregates.count;
    for (const std::uint32_t other : graph[i]) aggregates.of[other] = aggregates.count;
    ++aggregates.count;
  }
  const std::vector<std::uint32_t> first = aggregates.of;
  for (std::uint32_t i = 0; i < graph.count(); ++i) {
    if (first[i] != NONE) continue;
    std::vector<std::uint32_t> around;
    for (const std::uint32_t other : graph[i])
      if (first[other] != NONE) around.push_back(first[other]);
    // The one with the most neighbours in it; of several the first.
    std::sort(around.begin(), around.end());
    std::ptrdiff_t most = 0;
    for (auto run = around.begin(); run != around.end();) {
      const auto end = std::upper_bound(run, around.end(), *run);
      if (end - run > most) {
        most = end - run;
        aggregates.of[i] = *run;
      }
      run = end;
    }
  }
  return aggregates;
}

// Numbers the aggregates so that those of a connected part follow each other.
std::vector<std::uint32_t> sortByPart(const std::vector<std::uint32_t>& parts, Aggregates& aggregates) {
  std::vector<std::uint32_t> order(parts.size()), place(parts.size()), sorted(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return parts[a] < parts[b]; });
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    place[order[k]] = k;
    sorted[k] = parts[order[k]];
  }
  for (std::uint32_t& own : aggregates.of) own = place[own];
  return sorted;
}

Lists coarsened(const Lists& graph, const Aggregates& aggregates) {
  std::vector<std::vector<std::uint32_t>> around(aggregates.count);
  for (std::uint32_t i = 0; i < graph.count(); ++i)
    for (const std::uint32_t other : graph[i])
      if (aggregates.of[other] != aggregates.of[i]) around[aggregates.of[i]].push_back(aggregates.of[other]);
  Lists coarse;
  for (std::vector<std::uint32_t>& others : around) {
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    coarse.entries.insert(coarse.entries.end(), others.begin(), others.end());
    coarse.closeEntry();
  }
  return coarse;
}

// The coarse vertices that vertex i of a graph hangs on, ascending.
std::vector<std::pair<std::uint32_t, double>> weightsOf(const Lists& graph, const Aggregates& aggregates,
                                                        std::uint32_t i) {
  std::vector<std::pair<std::uint32_t, double>> weights;
  const auto add = [&](std::uint32_t aggregate, double weight) {
    const auto found = std::find_if(weights.begin(), weights.end(),
                                    [&](const auto& each) { return each.first == aggregate; });
    if (found == weights.end())
      weights.emplace_back(aggregate, weight);
    else
      found->second += weight;
  };
  const auto neighbours = static_cast<double>(graph[i].size());
  add(aggregates.of[i], graph[i].empty() ? 1 : 1.0 / 3);
  for (const std::uint32_t other : graph[i]) add(aggregates.of[other], 2.0 / 3 / neighbours);
  std::sort(weights.begin(), weights.end());
  return weights;
}

template <class Real>
class HierarchyBuilder {
 public:
  HierarchyBuilder(const Cloth& cloth, const Cuts& cuts)
      : cloth_(cloth), cutMasks_(makeCutMasks(cloth, cuts)) {
    if (!cuts.empty()) left_ = remainingLists(cloth, cuts);
    hierarchy_.particles = cloth.particleCount();
  }

  Hierarchy<Real> build() {
    for (const Piece& piece : cloth_.pieces()) addPiece(piece);
    // Weights were added a level of a piece at a time: in the order of the vertices they follow each other.
    orderProlongation();
    return std::move(hierarchy_);
  }

 private:
  using Weight = typename Hierarchy<Real>::Weight;
  using Block = typename Hierarchy<Real>::Block;

  [[nodiscard]] const SpringLists& lists() const { return left_ ? *left_ : cloth_.lists(); }
  void addPiece(const Piece& piece) {
    hierarchy_.pieces.emplace_back();
    Lists graph = springGraph(lists(), piece, cutMasks_);
    LevelParams level{};
    level.fineFirst = piece.firstParticle;
    for (bool isCoarsest = false; !isCoarsest;) {
      Aggregates aggregates = aggregate(graph);
      Lists coarse = coarsened(graph, aggregates);
      std::vector<std::uint32_t> parts = partsOf(coarse);
      isCoarsest = largestPart(parts) <= COARSEST_VERTICES;
      if (isCoarsest) parts = sortByPart(parts, aggregates);
      level.fineCount = graph.count();
      level.coarseFirst = hierarchy_.coarseVertices;
      level.coarseCount = aggregates.count;
      hierarchy_.coarseVertices += aggregates.count;
      addWeights(graph, aggregates, level);
      level.firstBlock = static_cast<std::uint32_t>(hierarchy_.blocks.size());
      hierarchy_.pieces.back().empty() ? addFirstBlocks(piece, level) : addBlocks(level);
      level.endBlock = static_cast<std::uint32_t>(hierarchy_.blocks.size());
      hierarchy_.pieces.back().push_back(level);
      if (isCoarsest) addParts(parts, level);
      level.fineFirst = hierarchy_.particles + level.coarseFirst;
      graph = std::move(coarse);
    }
  }

  // Of all fine vertices of a level; and the same by coarse vertex.
  void addWeights(const Lists& graph, const Aggregates& aggregates, const LevelParams& level) {
    std::vector<std::vector<Weight>> byCoarse(level.coarseCount);
    std::vector<std::vector<Weight>>& byFine = weights_;
    byFine.resize(hierarchy_.particles + level.coarseFirst + level.coarseCount);
    for (std::uint32_t i = 0; i < graph.count(); ++i)
      for (const auto& [aggregate, weight] : weightsOf(graph, aggregates, i)) {
        byFine[level.fineFirst + i].push_back({level.coarseFirst + aggregate, static_cast<Real>(weight)});
        byCoarse[aggregate].push_back({level.fineFirst + i, static_cast<Real>(weight)});
      }
    for (const std::vector<Weight>& fine : byCoarse) {
      hierarchy_.restrictionStarts.push_back(static_cast<std::uint32_t>(hierarchy_.restriction.size()));
      hierarchy_.restriction.insert(hierarchy_.restriction.end(), fine.begin(), fine.end());
    }
  }

  void addFirstBlocks(const Piece& piece, const LevelParams& level) {
    // Of each particle the aggregates that its elements touch; of each aggregate those particles.
    std::vector<std::uint32_t>&starts = hierarchy_.touchedStarts, &touched = hierarchy_.touched;
    std::vector<std::vector<std::uint32_t>> touching(level.coarseCount);
    for (std::uint32_t i = level.fineFirst; i < level.fineFirst + level.fineCount; ++i) {
      std::vector<std::uint32_t> own;
      forEachElementParticle(lists(), piece, i, [&](std::uint32_t particle) {
        for (const Weight& weight : weights_[particle]) own.push_back(weight.vertex);
      });
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      for (const std::uint32_t vertex : own) touching[vertex - level.coarseFirst].push_back(i);
      touched.insert(touched.end(), own.begin(), own.end());
      starts.push_back(static_cast<std::uint32_t>(touched.size()));
    }
    addRows(level, [&](std::uint32_t row, auto add) {
      for (const std::uint32_t i : touching[row - level.coarseFirst]) {
        for (std::uint32_t n = starts[i]; n < starts[i + 1]; ++n)
          if (touched[n] >= row) add(touched[n], i);
        add(ALL_VERTICES, i);
      }
    });
    putElementBlocks(level);
  }

  void putElementBlocks(const LevelParams& level) {
    const std::vector<std::uint32_t>& starts = hierarchy_.touchedStarts;
    std::vector<std::uint32_t>&firsts = hierarchy_.elementBlockStarts, &numbers = hierarchy_.elementBlocks;
    for (std::uint32_t i = level.fineFirst; i < level.fineFirst + level.fineCount; ++i) {
      const std::uint32_t count = starts[i + 1] - starts[i];
      firsts.push_back(firsts.back() + count * (count + 3) / 2);
    }
    numbers.resize(firsts.back());
    std::vector<std::uint32_t> next(firsts.begin() + level.fineFirst, firsts.end());
    for (auto n = level.firstBlock; n < hierarchy_.blocks.size(); ++n)
      for (std::uint32_t k = hierarchy_.blocks[n].firstSource; k < hierarchy_.blocks[n].endSource; ++k)
        numbers[next[hierarchy_.sources[k] - level.fineFirst]++] = static_cast<std::uint32_t>(n);
  }

  void addBlocks(const LevelParams& level) {
    const LevelParams& fine = hierarchy_.pieces.back().back();
    struct Source {
      std::uint32_t column, source;
    };
    std::vector<std::vector<Source>> rows(level.coarseCount);
    for (std::uint32_t k = fine.firstBlock; k < fine.endBlock; ++k) {
      const Block& block = hierarchy_.blocks[k];
      if (block.column == ALL_VERTICES) {
        for (const Weight& a : weights_[hierarchy_.particles + block.row])
          rows[a.vertex - level.coarseFirst].push_back({ALL_VERTICES, 2 * k});
        continue;
      }
      const auto put = [&](std::uint32_t row, std::uint32_t column, std::uint32_t source) {
        for (const Weight& a : weights_[hierarchy_.particles + row])
          for (const Weight& b : weights_[hierarchy_.particles + column])
            if (a.vertex <= b.vertex) rows[a.vertex - level.coarseFirst].push_back({b.vertex, source});
      };
      put(block.row, block.column, 2 * k);
      if (block.row != block.column) put(block.column, block.row, 2 * k + 1);
    }
    addRows(level, [&](std::uint32_t row, auto add) {
      for (const Source& source : rows[row - level.coarseFirst]) add(source.column, source.source);
    });
  }

  // `collect(row, add)` calls add(column, source) for all of a row, the sources of a column ascending.
  template <class Collect>
  void addRows(const LevelParams& level, Collect collect) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    for (std::uint32_t row = level.coarseFirst; row < level.coarseFirst + level.coarseCount; ++row) {
      hierarchy_.blockStarts.push_back(static_cast<std::uint32_t>(hierarchy_.blocks.size()));
      all.clear();
      collect(row, [&](std::uint32_t column, std::uint32_t source) { all.emplace_back(column, source); });
      std::sort(all.begin(), all.end());
      for (const auto& [column, source] : all) {
        const auto next = static_cast<std::uint32_t>(hierarchy_.sources.size());
        const bool isNew = hierarchy_.blocks.size() == hierarchy_.blockStarts.back() ||
                           hierarchy_.blocks.back().column != column;
        if (isNew) hierarchy_.blocks.push_back({row, column, next, next});
        hierarchy_.sources.push_back(source);
        hierarchy_.blocks.back().endSource = next + 1;
      }
    }
  }

  void addParts(const std::vector<std::uint32_t>& parts, const LevelParams& level) {
    std::vector<DensePart>& all = hierarchy_.parts.emplace_back();
    for (std::uint32_t k = 0; k < parts.size(); ++k) {
      if (k == 0 || parts[k] != parts[k - 1]) {
        DensePart part{};
        part.first = level.coarseFirst + k;
        all.push_back(part);
      }
      ++all.back().count;
    }
    for (DensePart& part : all) {
      part.firstEntry = hierarchy_.denseEntries;
      hierarchy_.denseEntries += (6 * part.count) * (6 * part.count);
      part.firstBlock = hierarchy_.blockStarts[part.first];
      part.endBlock = part.first + part.count == level.coarseFirst + level.coarseCount
                          ? level.endBlock
                          : hierarchy_.blockStarts[part.first + part.count];
    }
  }

  void orderProlongation() {
    weights_.resize(hierarchy_.particles + hierarchy_.coarseVertices);
    for (const std::vector<Weight>& own : weights_) {
      hierarchy_.prolongationStarts.push_back(static_cast<std::uint32_t>(hierarchy_.prolongation.size()));
      hierarchy_.prolongation.insert(hierarchy_.prolongation.end(), own.begin(), own.end());
    }
    hierarchy_.prolongationStarts.push_back(static_cast<std::uint32_t>(hierarchy_.prolongation.size()));
    hierarchy_.restrictionStarts.push_back(static_cast<std::uint32_t>(hierarchy_.restriction.size()));
    hierarchy_.blockStarts.push_back(static_cast<std::uint32_t>(hierarchy_.blocks.size()));
  }

  const Cloth& cloth_;
  std::vector<std::uint32_t> cutMasks_;
  std::optional<SpringLists> left_;           // of what meshes gather over, with cuts
  std::vector<std::vector<Weight>> weights_;  // by vertex
  Hierarchy<Real> hierarchy_;
};

}  // namespace

template <class Real>
Hierarchy<Real> makeHierarchy(const Cloth& cloth, const Cuts& cuts) {
  return HierarchyBuilder<Real>(cloth, cuts).build();
}

template Hierarchy<float> makeHierarchy(const Cloth&, const Cuts&);
template Hierarchy<double> makeHierarchy(const Cloth&, const Cuts&);

}  // namespace clothsim
