#include "scene/pins.h"

namespace clothsim {

namespace {

// One entry a grid point, row-major.
class PointTable {
 public:
  PointTable(const ClothSettings& cloth, int value)
      : columns_(static_cast<std::size_t>(cloth.numWidthPoints)),
        values_(columns_ * static_cast<std::size_t>(cloth.numHeightPoints), value) {}

  int& at(GridPoint point) {
    return values_[static_cast<std::size_t>(point.row) * columns_ + static_cast<std::size_t>(point.column)];
  }
  std::vector<int> take() && { return std::move(values_); }

 private:
  std::size_t columns_;
  std::vector<int> values_;
};

// Calls visit(point) for every point of the block, until it returns false.
template <class Visit>
void visitPoints(const GridRange& range, Visit visit) {
  for (int row = range.from.row; row <= range.to.row; ++row)
    for (int column = range.from.column; column <= range.to.column; ++column)
      if (!visit(GridPoint{column, row})) return;
}

}  // namespace

std::string pointText(GridPoint point) {
  std::string text = "[";
  text += std::to_string(point.column) + ", " + std::to_string(point.row) + "]";
  return text;
}

GridRange pointsOf(const Pin& pin, const ClothSettings& cloth) {
  const int lastColumn = cloth.numWidthPoints - 1, lastRow = cloth.numHeightPoints - 1;
  if (const auto* point = std::get_if<GridPoint>(&pin)) return {*point, *point};
  if (const auto* range = std::get_if<GridRange>(&pin)) return *range;
  const bool vertical = cloth.orientation == Orientation::vertical;
  const int top = vertical ? lastRow : 0, bottom = vertical ? 0 : lastRow;
  switch (std::get<GridSide>(pin)) {
    case GridSide::top:
      return {{0, top}, {lastColumn, top}};
    case GridSide::bottom:
      return {{0, bottom}, {lastColumn, bottom}};
    case GridSide::left:
      return {{0, 0}, {0, lastRow}};
    case GridSide::right:
      return {{lastColumn, 0}, {lastColumn, lastRow}};
  }
  return {};
}

const std::vector<Pin>& pinsOf(const PinMotion& motion, const ClothSettings& cloth) {
  return motion.pinned.empty() ? cloth.pinned : motion.pinned;
}

std::vector<int> pinMotionOfPoints(const ClothSettings& cloth) {
  PointTable motions(cloth, NO_MOTION);
  for (std::size_t i = 0; i < cloth.pinMotion.size(); ++i)
    for (const Pin& pin : pinsOf(cloth.pinMotion[i], cloth))
      visitPoints(pointsOf(pin, cloth), [&](GridPoint point) {
        motions.at(point) = static_cast<int>(i);
        return true;
      });
  return std::move(motions).take();
}

std::optional<PinConflict> findPinConflict(const ClothSettings& cloth) {
  if (cloth.pinMotion.empty()) return std::nullopt;
  constexpr int free = -2;
  PointTable motions(cloth, free);
  for (const Pin& pin : cloth.pinned)
    visitPoints(pointsOf(pin, cloth), [&](GridPoint point) {
      motions.at(point) = NO_MOTION;
      return true;
    });
  std::optional<PinConflict> conflict;
  for (std::size_t i = 0; i < cloth.pinMotion.size(); ++i) {
    const std::vector<Pin>& pins = pinsOf(cloth.pinMotion[i], cloth);
    for (std::size_t k = 0; k < pins.size() && !conflict; ++k)
      visitPoints(pointsOf(pins[k], cloth), [&](GridPoint point) {
        int& motion = motions.at(point);
        if (motion == free)
          conflict = PinConflict{i, k, point, std::nullopt};
        else if (motion != NO_MOTION && motion != static_cast<int>(i))
          conflict = PinConflict{i, k, point, static_cast<std::size_t>(motion)};
        motion = static_cast<int>(i);
        return !conflict;
      });
  }
  return conflict;
}

}  // namespace clothsim
