// A contact sheet: pictures in rows and columns on one page, with headings.
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
  std::string alert;     // written on the picture, which is dimmed then; "" for none
  SheetHeading heading;  // above it where the columns have no headings
};

struct ContactSheet {
  std::string title, subtitle;
  std::vector<SheetHeading> columns;            // headings; empty: each picture has one
  std::vector<std::vector<SheetHeading>> rows;  // headings, several a row; empty: none
  std::size_t columnCount = 1;
  int pictureWidth = 0, pictureHeight = 0;
  std::vector<SheetPicture> pictures;  // row by row
};

// The size of the page and the places of the pictures [pixels from the top left]. The size of text follows
// that of the pictures.
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
