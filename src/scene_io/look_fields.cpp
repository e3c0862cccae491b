// The entries of the table of scene keys for looks: of the scene, and of single cloths.
#include <array>

#include "scene_io/field_table.h"

namespace clothsim {
namespace {

constexpr Limits channel{.low = 0, .high = 1}, repeatLimits{.low = 0.01, .high = 1000},
    threadLimits{.low = 1e-5, .high = 1}, strengthLimits{.low = 0, .high = 10},
    reliefLimits{.low = -1, .high = 1}, thicknessLimits{.low = 0, .high = 1},
    fuzzLimits{.low = 0, .high = 0.1};

}  // namespace

template <>
std::span<const Field<RenderSettings>> fieldsOf<RenderSettings>() {
  using R = RenderSettings;
  static const std::array fields{
      field("shader", &R::shader, "Shading model of the cloth.").oneOf(shadingModels),
      field(
          "color", &R::color,
          "Colour of the front: the upper side of a lying cloth, +z of a standing one; of denim the warp's.")
          .in("sRGB")
          .within(channel)
          .as(Format::color)
          .byDefault("of the material; without one [0.7, 0.1, 0.12]"),
      field("back_color", &R::backColor, "Colour of the back of the cloth; of denim the weft's.")
          .in("sRGB")
          .within(channel)
          .as(Format::color)
          .byDefault("of the material; without one [0.86, 0.7, 0.46]"),
      field("texture", &R::texture,
            "Print (tartan, stripes, checker) or height map (quilt, knit, hammered), or the path of a PNG.")
          .byDefault("of texture: tartan; of bump and displacement: quilt; of fabric: none"),
      field("texture_repeat", &R::textureRepeat, "Repeats of the texture along the cloth's longer side.")
          .within(repeatLimits)
          .usually(0.5, 50),
      field(
          "weave", &R::weave,
          "Weave of the model fabric; jersey is a knit, velvet a pile, none a film, as paper and rubber are.")
          .oneOf(weaves)
          .byDefault("of the material; without one plain"),
      field("thread_spacing", &R::threadSpacing,
            "Distance between threads of the model fabric, along the weft, or of wales; 0.0003 to 0.002 in "
            "real "
            "cloth.")
          .in("m")
          .within(threadLimits)
          .usually(2e-4, 0.02)
          .byDefault("of the material; without one 0.0015"),
      field("gloss", &R::gloss, "Gloss of the model fabric: 0 is wool, 1 is silk.")
          .within(channel)
          .byDefault("of the material; without one 0.3"),
      field("fuzz", &R::fuzz,
            "Length of the loose fibres of the model fabric; velvet: at least 0.0015. Not drawn in draft "
            "quality.")
          .in("m")
          .within(fuzzLimits)
          .usually(0, 0.005)
          .byDefault("of the material: of wool 0.002; without one 0"),
      field("normal_strength", &R::normalStrength,
            "Strength of weaves and bumps: 0 is flat, 1 true to their height.")
          .within(strengthLimits)
          .usually(0, 3),
      field("height", &R::height, "Height of bump and displacement maps, from black to white.")
          .in("m")
          .within(reliefLimits)
          .usually(-0.05, 0.05),
      field("strain_range", &R::strainRange, "Strain l/L - 1 at the end of the strain map's colour scale.")
          .within({.low = 1e-6, .high = 100})
          .usually(0.001, 1),
      field("light", &R::light, "Direction towards the main light, of any length.")
          .within({.nonZero = true})
          .byDefault("from the viewer's side, upper left"),
      field("light_size", &R::lightSize, "Angle across the main light, in final quality; 0: sharp shadows.")
          .in("degrees")
          .within({.low = 0, .high = 60})
          .usually(0, 20),
      field("stage", &R::stage,
            "Where the scene stands: a studio's sweep, a table top, a room by a window, a dark stage; none.")
          .oneOf(stages),
      field("background", &R::background, "Background of the picture; studio: that of the stage.")
          .oneOf(backgrounds),
      field("background_color", &R::backgroundColor, "Colour of the plain background.")
          .in("sRGB")
          .within(channel)
          .as(Format::color),
      field("thickness", &R::thickness,
            "How thick the cloth is drawn, with round edges; 0: as a sheet without thickness.")
          .in("m")
          .within(thicknessLimits)
          .usually(0, 0.02)
          .byDefault("of the cloth, at most half the distance of its points; in draft quality 0"),
      field(
          "smooth", &R::smooth,
          "Draw cloth as a smooth surface through the particles; false: by their triangles, as draft does."),
      field("ground", &R::ground, "Draw a floor if the scene has no horizontal plane."),
  };
  return fields;
}

template <>
std::span<const Field<ClothLook>> fieldsOf<ClothLook>() {
  using L = ClothLook;
  constexpr std::string_view asScene = "as the scene's render and the cloth's material have it";
  static const std::array fields{
      field("color", &L::color, "Colour of this cloth's front; of denim the warp's.")
          .in("sRGB")
          .within(channel)
          .as(Format::color)
          .byDefault(asScene),
      field("back_color", &L::backColor, "Colour of this cloth's back; of denim the weft's.")
          .in("sRGB")
          .within(channel)
          .as(Format::color)
          .byDefault(asScene),
      field("texture", &L::texture, "Print or height map of this cloth, as render.texture; \"\": none.")
          .byDefault(asScene),
      field("texture_repeat", &L::textureRepeat, "Repeats of the texture along this cloth's longer side.")
          .within(repeatLimits)
          .usually(0.5, 50)
          .byDefault(asScene),
      field("weave", &L::weave, "Weave or knit of this cloth.").oneOf(weaves).byDefault(asScene),
      field("thread_spacing", &L::threadSpacing, "Distance between the threads of this cloth.")
          .in("m")
          .within(threadLimits)
          .usually(2e-4, 0.02)
          .byDefault(asScene),
      field("gloss", &L::gloss, "Gloss of this cloth: 0 is wool, 1 is silk.")
          .within(channel)
          .byDefault(asScene),
      field("fuzz", &L::fuzz, "How far loose fibres stand off this cloth.")
          .in("m")
          .within(fuzzLimits)
          .usually(0, 0.005)
          .byDefault(asScene),
      field("normal_strength", &L::normalStrength, "Strength of this cloth's weave and bumps.")
          .within(strengthLimits)
          .usually(0, 3)
          .byDefault(asScene),
      field("height", &L::height, "Height of this cloth's bump or displacement map, from black to white.")
          .in("m")
          .within(reliefLimits)
          .usually(-0.05, 0.05)
          .byDefault(asScene),
      field("thickness", &L::thickness, "How thick this cloth is drawn; 0: as a sheet without thickness.")
          .in("m")
          .within(thicknessLimits)
          .usually(0, 0.02)
          .byDefault(asScene),
  };
  return fields;
}

}  // namespace clothsim
