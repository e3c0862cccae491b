// What a viewer may ask for on top of any model: springs by kind, pins; and cloth that has been cut.
#include <set>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "render/strain_scale.h"

namespace clothsim {
namespace {

// A vertical sheet that fills the picture, in a dark grey that no spring has.
class OverlayTest : public GlTest {
 protected:
  static Scene sheet() {
    Scene scene;
    ClothSettings& cloth = scene.cloths[0];
    cloth.numWidthPoints = cloth.numHeightPoints = 9;
    cloth.pinned = {GridPoint{4, 4}};
    scene.render.shader = "diffuse";
    scene.render.color = scene.render.backColor = {0.1, 0.1, 0.1};
    scene.camera.position = Vec3d{0.5, 1.9, 0.52};
    scene.camera.target = Vec3d{0.5, 1, 0.5};
    return scene;
  }

  Scene scene_ = sheet();
  Cloth cloth_{scene_};
  std::optional<gl::Buffer<Particle4>> positions_;
  std::optional<Renderer> renderer_;

  void SetUp() override {
    GlTest::SetUp();
    std::vector<Particle4> particles;
    for (std::uint32_t i = 0; i < cloth_.particleCount(); ++i) {
      const Vec3f p = cloth_.positions()[i].cast<float>();
      particles.push_back({p.x, p.y, p.z, static_cast<float>(cloth_.inverseMasses()[i])});
    }
    positions_.emplace("positions", particles);
    renderer_.emplace(cloth_, scene_, RenderOptions{});
  }
  Image draw(const ViewOptions& view) {
    renderer_->setView(view);
    return renderImage(*renderer_, positions_->name(), Camera(scene_, cloth_), 0, 200, 120);
  }
  // How many pixels of the picture are nearly `color`.
  static int pixelsOf(const Image& image, const std::array<float, 3>& color) {
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      bool alike = true;
      for (std::size_t channel = 0; channel < 3; ++channel)
        alike = alike && std::abs(image.rgb[i + channel] - 255 * color[channel]) < 28;
      count += alike ? 1 : 0;
    }
    return count;
  }
};

TEST_F(OverlayTest, SpringsAppearKindByKindInTheColoursOfTheLegend) {
  for (const SpringKind kind : {SpringKind::structural, SpringKind::shear, SpringKind::bending}) {
    ViewOptions view;
    EXPECT_LT(pixelsOf(draw(view), springColor(kind)), 20);
    view.showSprings[static_cast<std::size_t>(kind)] = true;
    EXPECT_GT(pixelsOf(draw(view), springColor(kind)), 300) << static_cast<int>(kind);
  }
}

TEST_F(OverlayTest, CutSpringsAreNotDrawn) {
  ViewOptions view;
  view.showSprings = {true, true, true};
  const int whole = pixelsOf(draw(view), springColor(SpringKind::structural));
  Cuts cuts;
  for (double at = 0.5; at < 8; ++at) cutAlong(cuts, cloth_, 0, {at, -1}, {at, 9});
  renderer_->setCuts(cuts);
  EXPECT_LT(pixelsOf(draw(view), springColor(SpringKind::structural)), 0.7 * whole);
  renderer_->setCuts({});
  EXPECT_EQ(pixelsOf(draw(view), springColor(SpringKind::structural)), whole);
}

TEST_F(OverlayTest, APinIsADotWhereItsParticleIs) {
  ViewOptions view;
  view.showPins = true;
  const Image with = draw(view), without = draw({});
  std::set<std::pair<int, int>> changed;
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x)
      if (test::pixelAt(with, x, y) != test::pixelAt(without, x, y)) changed.insert({x, y});
  ASSERT_GT(changed.size(), 10u);
  for (const auto& [x, y] : changed) {
    EXPECT_NEAR(x, 100, 6);
    EXPECT_NEAR(y, 60, 6);
  }
}

TEST_F(OverlayTest, StrainIsMeasuredWhereTheModelShowsIt) {
  scene_.render.shader = "strain";
  renderer_->configure(scene_);
  std::vector<Particle4> stretched = positions_->download();
  for (Particle4& p : stretched) {
    p.x *= 1.05f;
    p.z *= 1.05f;
  }
  positions_->upload(stretched);
  const Image image = draw({});
  EXPECT_NEAR(renderer_->strainAt(40), 0.05, 1e-4);
  EXPECT_NEAR(renderer_->strainAt(0), 0.05, 1e-4);
  const std::array<int, 3> middle = test::pixelAt(image, 90, 50);
  EXPECT_GT(middle[0], middle[2] + 40) << "half way to the end of the scale is orange";
}

TEST_F(OverlayTest, TheStrainScaleIsThatOfTheScene) {
  RenderSettings settings;
  settings.strainRange = 0.3;
  const std::vector<StrainStop> scale = strainScale(settings);
  EXPECT_EQ(scale.front().strain, -0.3);
  EXPECT_EQ(scale.back().strain, 0.3);
  for (std::size_t i = 1; i < scale.size(); ++i) EXPECT_GT(scale[i].strain, scale[i - 1].strain);
}

}  // namespace
}  // namespace clothsim
