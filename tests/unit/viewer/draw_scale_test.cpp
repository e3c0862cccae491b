#include <gtest/gtest.h>

#include "render/draw_scale.h"
#include "render/quality.h"

namespace clothsim {
namespace {

// Pictures whose time grows with their pixels, from a device that needs `whole` [s] for all of them.
void draw(DrawScale& scale, double whole, int pictures) {
  for (int i = 0; i < pictures; ++i) scale.drawn(0.001 + whole * scale.scale() * scale.scale());
}

TEST(DrawScale, KeepsAllPixelsWhereTheyFitIntoTheBudget) {
  DrawScale scale(0.015);
  draw(scale, 0.010, 100);
  EXPECT_EQ(scale.scale(), 1);
}

TEST(DrawScale, FindsTheScaleThatKeepsTheBudgetWithinASecondOfPictures) {
  DrawScale scale(0.015);
  draw(scale, 0.030, 30);
  EXPECT_LT(scale.scale(), 0.75);
  EXPECT_LE(0.001 + 0.030 * scale.scale() * scale.scale(), 1.1 * 0.015);
  const double found = scale.scale();
  draw(scale, 0.030, 300);
  EXPECT_EQ(scale.scale(), found) << "and stays there";
}

TEST(DrawScale, GrowsAgainWhenPicturesBecomeCheaper) {
  DrawScale scale(0.015);
  draw(scale, 0.060, 60);
  EXPECT_EQ(scale.scale(), DrawScale::LEAST);
  draw(scale, 0.008, 2000);
  EXPECT_EQ(scale.scale(), 1);
}

TEST(DrawScale, CaresForNoSinglePictureThatWasInterrupted) {
  DrawScale scale(0.015);
  for (int i = 0; i < 200; ++i) scale.drawn(i % 7 == 0 ? 0.2 : 0.010);
  EXPECT_EQ(scale.scale(), 1);
}

TEST(DrawScale, WithoutABudgetDrawsAllPixelsHoweverLongItTakes) {
  DrawScale scale(pictureBudget(Quality::final));
  draw(scale, 1.0, 100);
  EXPECT_EQ(scale.scale(), 1);
}

TEST(Quality, FinalIsTheSameOnEveryDeviceAndDraftCostsLess) {
  EXPECT_EQ(withQuality({}, Quality::final, true).samples, 4);
  EXPECT_EQ(withQuality({}, Quality::final, false).samples, 4);
  EXPECT_FALSE(withQuality({}, Quality::final, true).keepsStill);
  EXPECT_EQ(withQuality({}, Quality::normal, true).samples, 1);
  EXPECT_LT(withQuality({}, Quality::draft, true).shadowMapSize, RenderOptions{}.shadowMapSize);
  EXPECT_EQ(withQuality({}, Quality::draft, false).subdivisions, 0);
  EXPECT_EQ(withQuality({}, Quality::normal, true).subdivisions, 1);
  EXPECT_GT(withQuality({}, Quality::normal, true).flatness, 0);
  for (const bool software : {false, true}) {
    EXPECT_EQ(withQuality({}, Quality::final, software).subdivisions, 3);
    EXPECT_EQ(withQuality({}, Quality::final, software).flatness, 0) << "highlights are smooth everywhere";
  }
  for (const Quality quality : {Quality::draft, Quality::normal, Quality::final})
    EXPECT_EQ(qualityNamed(nameOf(quality)), quality);
  EXPECT_FALSE(qualityNamed("auto"));
}

}  // namespace
}  // namespace clothsim
