#include "output/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "output/picture_font.h"

namespace clothsim {
namespace {

constexpr Color8 paper{0xf6, 0xf5, 0xf2}, ink{0x22, 0x26, 0x2b}, quiet{0x6d, 0x74, 0x7c},
    alertInk{0xff, 0xd2, 0x8a}, alertPaper{0x2b, 0x24, 0x1d};

// The layout of a sheet for pictures of a given size.
struct Layout {
  explicit Layout(const ContactSheet& sheet)
      : scale(std::clamp(std::min(sheet.pictureWidth / 460.0, sheet.pictureHeight / 345.0), 0.5, 8.0)),
        titleSize(at(38)),
        headingSize(at(30)),
        smallSize(at(21)),
        margin(at(36)),
        gap(at(22)) {
    for (const std::vector<SheetHeading>& row : sheet.rows)
      for (const SheetHeading& heading : row)
        rowHeadings = std::max(
            {rowHeadings, font.width(heading.name, smallSize), font.width(heading.value, headingSize)});
    if (rowHeadings > 0) rowHeadings = std::min(rowHeadings, sheet.pictureWidth) + at(28);
    left = margin + rowHeadings;
    const bool hasCaptions =
        std::any_of(sheet.pictures.begin(), sheet.pictures.end(),
                    [](const SheetPicture& picture) { return !picture.caption.empty(); });
    const int columnHeading = at(48), caption = hasCaptions ? at(36) : 0;
    top = margin + at(66) + (sheet.columns.empty() ? 0 : columnHeading);
    aboveCell = sheet.columns.empty() ? columnHeading : 0;
    cellHeight = aboveCell + sheet.pictureHeight + caption;
    const std::size_t count = std::max<std::size_t>(1, sheet.pictures.size());
    columns = static_cast<int>(sheet.columnCount);
    rows = static_cast<int>((count + sheet.columnCount - 1) / sheet.columnCount);
    stepX = sheet.pictureWidth + gap;
    stepY = cellHeight + gap;
    width = left + columns * sheet.pictureWidth + (columns - 1) * gap + margin;
    height = top + rows * cellHeight + (rows - 1) * gap + margin - at(8);
  }

  [[nodiscard]] SheetPlan::Place placeOf(std::size_t picture) const {
    const auto column = static_cast<int>(picture) % columns, row = static_cast<int>(picture) / columns;
    return {left + column * stepX, top + aboveCell + row * stepY};
  }
  [[nodiscard]] int at(double pixels) const { return static_cast<int>(std::lround(pixels * scale)); }

  double scale;
  int titleSize, headingSize, smallSize, margin, gap;
  PictureFont font;
  int rowHeadings = 0, left = 0, top = 0, aboveCell = 0, cellHeight = 0, columns = 0, rows = 0, stepX = 0,
      stepY = 0;
  int width = 0, height = 0;
};

// Draws a heading such as "cloth.ks  500 N/m" on one baseline.
void drawHeading(Image& page, const Layout& layout, const SheetHeading& heading, int x, int baseline,
                 int room) {
  const PictureFont& font = layout.font;
  const std::string value = font.fitted(heading.value, layout.headingSize, room);
  const int space = layout.at(12);
  const int nameRoom = room - font.width(value, layout.headingSize) - space;
  if (font.width(heading.name, layout.smallSize) <= nameRoom)
    x = font.draw(page, heading.name, layout.smallSize, x, baseline, quiet) + space;
  font.draw(page, value, layout.headingSize, x, baseline, ink);
}

// Draws the headings of a row one below the other, centred in its height.
void drawRowHeadings(Image& page, const Layout& layout, const std::vector<SheetHeading>& headings,
                     int middle) {
  const int line = layout.at(84), room = layout.rowHeadings - layout.at(20);
  int y = middle - line * static_cast<int>(headings.size()) / 2;
  for (const SheetHeading& heading : headings) {
    const PictureFont& font = layout.font;
    font.draw(page, font.fitted(heading.name, layout.smallSize, room), layout.smallSize, layout.margin,
              y + layout.at(26), quiet);
    font.draw(page, font.fitted(heading.value, layout.headingSize, room), layout.headingSize, layout.margin,
              y + layout.at(60), ink);
    y += line;
  }
}

// The coverage of a pixel by a rectangle with round corners, smoothed over one pixel.
double roundedCover(double x, double y, double width, double height, double radius) {
  const double dx = std::max({radius - x, x - (width - radius), 0.0});
  const double dy = std::max({radius - y, y - (height - radius), 0.0});
  return std::clamp(radius - std::hypot(dx, dy) + 0.5, 0.0, 1.0);
}

// @param dimmed  draws it grey and pale, so that it is not taken for a result
void drawPicture(Image& page, const Image& image, int left, int top, double radius, bool dimmed) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel =
          &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(x))];
      Color8 color{pixel[0], pixel[1], pixel[2]};
      if (dimmed) {
        const double grey = 0.3 * pixel[0] + 0.59 * pixel[1] + 0.11 * pixel[2];
        for (std::size_t i = 0; i < 3; ++i)
          color[i] =
              static_cast<std::uint8_t>(std::lround(0.45 * (0.7 * grey + 0.3 * pixel[i]) + 0.55 * paper[i]));
      }
      blend(page, left + x, top + y, color,
            roundedCover(x + 0.5, y + 0.5, image.width, image.height, radius));
    }
}

// Writes text in the middle of a picture.
void drawAlert(Image& page, const Layout& layout, const std::string& alert, int left, int top, int width,
               int height) {
  const PictureFont& font = layout.font;
  const std::string text = font.fitted(alert, layout.smallSize, width - layout.at(60));
  const int plateWidth = font.width(text, layout.smallSize) + layout.at(36), plateHeight = layout.at(46);
  const int x0 = left + (width - plateWidth) / 2, y0 = top + (height - plateHeight) / 2;
  for (int y = 0; y < plateHeight; ++y)
    for (int x = 0; x < plateWidth; ++x)
      blend(page, x0 + x, y0 + y, alertPaper,
            0.92 * roundedCover(x + 0.5, y + 0.5, plateWidth, plateHeight, layout.at(10)));
  font.draw(page, text, layout.smallSize, x0 + layout.at(18), y0 + layout.at(30), alertInk);
}

void drawTitle(Image& page, const Layout& layout, const ContactSheet& sheet) {
  const PictureFont& font = layout.font;
  const int baseline = layout.margin + layout.at(30), room = layout.width - 2 * layout.margin;
  const std::string title = font.fitted(sheet.title, layout.titleSize, room);
  const int end = font.draw(page, title, layout.titleSize, layout.margin, baseline, ink) + layout.at(20);
  const int rest = layout.width - layout.margin - end;
  if (rest > layout.at(80))
    font.draw(page, font.fitted(sheet.subtitle, layout.smallSize, rest), layout.smallSize, end, baseline,
              quiet);
}

}  // namespace

SheetPlan planOf(const ContactSheet& sheet) {
  const Layout layout(sheet);
  SheetPlan plan{layout.width, layout.height, {}};
  for (std::size_t i = 0; i < sheet.pictures.size(); ++i) plan.pictures.push_back(layout.placeOf(i));
  return plan;
}

Image drawSheet(const ContactSheet& sheet) {
  const Layout layout(sheet);
  Image page{layout.width, layout.height, {}};
  page.rgb.reserve(3 * static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height));
  for (std::size_t i = 0; i < page.rgb.capacity(); ++i) page.rgb.push_back(paper[i % 3]);
  drawTitle(page, layout, sheet);

  for (std::size_t i = 0; i < sheet.columns.size(); ++i)
    drawHeading(page, layout, sheet.columns[i], layout.placeOf(i).x, layout.top - layout.at(16),
                sheet.pictureWidth);
  for (std::size_t i = 0; i < sheet.rows.size(); ++i)
    drawRowHeadings(page, layout, sheet.rows[i],
                    layout.placeOf(i * sheet.columnCount).y + sheet.pictureHeight / 2);
  for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
    const SheetPicture& picture = sheet.pictures[i];
    const auto [x, y] = layout.placeOf(i);
    if (layout.aboveCell > 0)
      drawHeading(page, layout, picture.heading, x, y - layout.at(16), sheet.pictureWidth);
    drawPicture(page, picture.image, x, y, layout.at(10), !picture.alert.empty());
    if (!picture.alert.empty())
      drawAlert(page, layout, picture.alert, x, y, sheet.pictureWidth, sheet.pictureHeight);
    layout.font.draw(page, layout.font.fitted(picture.caption, layout.smallSize, sheet.pictureWidth),
                     layout.smallSize, x, y + sheet.pictureHeight + layout.at(29), quiet);
  }
  return page;
}

}  // namespace clothsim
