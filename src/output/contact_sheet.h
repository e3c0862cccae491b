// A contact sheet: pictures in rows and columns on one page, with headings in words.
#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace clothsim {

struct SheetHeading {
  std::string name, value;  // "cloth.ks", "500 N/m"
};

struct SheetPicture {
  Image image;
  std::string caption;   // below it
  std::string alert;     // "" for none; the picture is dimmed and this stands upon it
  SheetHeading heading;  // above it, on a sheet without headings of columns
};

struct ContactSheet {
  std::string title, subtitle;
  std::vector<SheetHeading> columns;            // headings; empty: each picture has its own
  std::vector<std::vector<SheetHeading>> rows;  // headings, one below the other; empty: none
  std::size_t columnCount = 1;
  int pictureWidth = 0, pictureHeight = 0;
  std::vector<SheetPicture> pictures;  // row by row
};

// The page, and where its pictures lie upon it [pixels from the top left]; what is in them does not matter.
// All text grows with them.
struct SheetPlan {
  struct Place {
    int x = 0, y = 0;
  };
  int width = 0, height = 0;
  std::vector<Place> pictures;
};
[[nodiscard]] SheetPlan planOf(const ContactSheet& sheet);
[[nodiscard]] Image drawSheet(const ContactSheet& sheet);

}  // namespace clothsim
