#include "render/renderer_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "gl/context.h"
#include "render/look.h"
#include "render/stage_look.h"

namespace clothsim {
namespace {

constexpr GLenum canvasFormat = GL_RGBA8;      // as the screen shows it (shaders/render/tone.glsl)
constexpr GLenum exposureFormat = GL_RGBA16F;  // the same of an exposure, without steps
constexpr float planeDepthUnits = 256;  // 2e-6 of the distance each (Camera::projection, 24 bits of depth)
constexpr std::uint32_t MOST_CUT_STEPS = 2;
constexpr double MOST_VERTEX_DISTANCE = 12, MOST_THREAD_SPACING = 1;  // where vertices are lit [pixels]
constexpr double MOST_COARSE_CASTER = 6;       // longest side of cloth that casts shadows coarsely [texels]
constexpr double MOST_PLAIN_DISTANCE = 60;     // the same but for shadows and shine
constexpr std::size_t mostReadBack = 300'000;  // particles for which it pays to ask what has changed

// The longest side of a triangle of cloth: the diagonal of a cell [m].
double longestEdge(const Cloth& cloth) {
  double longest = 0;
  for (const Piece& piece : cloth.pieces()) {
    if (piece.isMesh) {
      longest = std::max(longest, piece.longestEdge);
      continue;
    }
    longest = std::max(longest, std::hypot(piece.nominalLength[toLeft], piece.nominalLength[toUpper]));
  }
  return longest;
}

// How far contact keeps layers apart, at least [m].
double layerDistance(const Scene& scene) {
  double least = INFINITY;
  for (const ClothSettings& cloth : scene.cloths) least = std::min(least, cloth.thicknessInUse());
  return std::max(least, 1e-6);
}

RenderOptions withSupportedSamples(RenderOptions options) {
  options.samples = gl::supportedSamples(options.samples);
  return options;
}

}  // namespace

Renderer::Parts::Parts(const Shared<Cloth>& drawn, const Shared<Scene>& first, const RenderOptions& wanted)
    : cloth(drawn),
      options(withSupportedSamples(wanted)),
      outline(outlineOf(*cloth)),
      scene(first),
      looks(looksOf(*scene, options.thick)),
      model(looks.front().model),
      programs(model, first->render, options.samples),
      isSoftware(gl::currentContextInfo().software),
      clothMesh(*cloth),
      colliders(wanted.sphereSegmentsAround, wanted.sphereSegmentsDown, longestEdge(*cloth)),
      shadowMap(wanted.shadowMapSize) {
  configure(first);
}

// What can fail comes first: after an error all is as it was.
void Renderer::Parts::configure(const Shared<Scene>& edited) {
  std::vector<PieceLook> wantedLooks = looksOf(*edited, options.thick);
  const ShadingModel wanted = wantedLooks.front().model;
  std::vector<ShadingModel> models;
  for (const PieceLook& look : wantedLooks) models.push_back(look.model);
  textures.choose(models, edited->render, directionToKeyLight(edited->render, outline.front));
  if (edited->render.background != scene->render.background || edited->render.stage != scene->render.stage)
    programs.chooseStage(edited->render);
  if (!(wanted == model)) programs.chooseModel(wanted);
  model = wanted;
  looks = std::move(wantedLooks);
  lookBlocks.resize(looks.size() > 1 ? looks.size() : 0);
  for (auto& block : lookBlocks)
    if (block.size() == 0) block = gl::Buffer<shared::RenderFrame>("render frame of a cloth", 1);
  if (model.measuresStrain) clothMesh.keepRestPositions(*cloth);
  scene = edited;
  const std::vector<float> thick = model.isThick ? drawnThickness(*scene, *cloth) : std::vector<float>{};
  if (thick != thickness) {
    thickness = thick;
    smooth.reset();
    if (model.isThick) clothMesh.setThickness(thickness);
  }
  stage = makeStage(outline, *scene);
  lowestFloor = std::min(lowestFloor, stage.floorHeight);
  stage.floorHeight = lowestFloor;  // a solid that is lifted does not take the floor with it
  colliders.build(*scene);
  frame = makeLook(scene->render, outline.front, textures.irradiance());
  setClothLook(looks.front().settings, frame);
  frame.stagePlace = groundPlace(*scene, stage);
  frame.ground.w = hasGround(*scene) ? 1 : 0;
  frame.flatness = static_cast<float>(options.flatness);
  shineFrom(nullptr);
  backdropSeen.reset();
  changes.forget();
}

// What can fail comes first.
void Renderer::Parts::setOptions(const RenderOptions& wanted) {
  RenderOptions next = withSupportedSamples(wanted);
  next.sphereSegmentsAround = options.sphereSegmentsAround;
  next.sphereSegmentsDown = options.sphereSegmentsDown;
  if (next.samples != options.samples) programs.chooseSamples(next.samples);
  if (next.shadowMapSize != options.shadowMapSize) {
    shadowMap = ShadowMap(next.shadowMapSize);
    skyShadowMaps.clear();
  }
  options = next;
  configure(scene);
}

// `aspect` is that of the picture in the end: of fewer pixels it would be rounded.
void Renderer::Parts::lookFrom(const Camera& camera, int width, int height, double aspect) {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const glm::mat4 clipFromView = camera.projection(aspect);
  const glm::mat4 worldFromView = glm::inverse(camera.view());
  frame.clipFromWorld = middleClipFromWorld = clipFromView * camera.view();
  frame.eye = glm::vec4(camera.eye(), 0);
  frame.pixels = {w, h, 1 / w, 1 / h};
  frame.rayMiddle = -worldFromView[2];
  frame.rayRight = worldFromView[0] / clipFromView[0][0];
  frame.rayUp = worldFromView[1] / clipFromView[1][1];
}

// The main light, or the point of it that shines in an exposure.
void Renderer::Parts::shineFrom(const Exposure* exposure) {
  glm::vec3 toLight = directionToKeyLight(scene->render, outline.front);
  frame.toSky[0] = glm::vec4(0);
  if (exposure != nullptr) {
    toLight = directionToLight(*exposure, toLight, scene->render.lightSize);
    while (skyShadowMaps.size() < SKY_DIRECTIONS) skyShadowMaps.emplace_back(options.shadowMapSize / 2);
    for (std::size_t k = 0; k < SKY_DIRECTIONS; ++k) {
      skyShadowMaps[k].cover(stage.reach, exposure->sky[k]);
      frame.skyShadowFromWorld[k] = skyShadowMaps[k].shadowFromWorld();
      frame.toSky[k] = glm::vec4(exposure->sky[k], skyShadowMaps[k].texelLength());
    }
  }
  shadowMap.cover(stage.reach, toLight);
  frame.shadowFromWorld = shadowMap.shadowFromWorld();
  frame.toKeyLight = glm::vec4(toLight, shadowMap.texelLength());
}

// From a point of the lens and a place in the pixels. What is at the distance of focus stays where it is.
void Renderer::Parts::lookThrough(const Exposure& exposure, const Camera& camera) {
  const glm::mat4 viewFromWorld = camera.view();
  const double focus =
      scene->camera.focus.value_or(static_cast<double>(glm::distance(camera.eye(), camera.target())));
  const glm::mat4 fromLens = viewThroughLens(exposure, scene->camera.aperture, focus) * viewFromWorld;
  glm::mat4 shifted(1);
  shifted[3] = glm::vec4(2 * exposure.pixel.x * frame.pixels.z, 2 * exposure.pixel.y * frame.pixels.w, 0, 1);
  frame.clipFromWorld = shifted * middleClipFromWorld * glm::inverse(viewFromWorld) * fromLens;
  frame.eye = glm::inverse(fromLens)[3];
}

// As fine as it shows at the distance of what the camera looks at; thick where that is seen.
void Renderer::Parts::chooseSurface(const Camera& camera, int height, double aspect) {
  constexpr double leastSeen = 0.25;  // [pixels]
  // Lines are those of the particles' triangles, and a lean surface is that of whole grids.
  const bool isOfGrids = !clothMesh.hasCuts() && !cloth->hasMesh();
  const bool isRough = !scene->render.smooth || options.subdivisions == 0 || model.blends ||
                       (options.flatness > 0 && !isOfGrids);
  const double distance = static_cast<double>(glm::distance(camera.eye(), camera.target()));
  pixelsAMetre = 0.5 * height * static_cast<double>(camera.projection(aspect)[1][1]) / distance;
  const auto thickest = std::max_element(thickness.begin(), thickness.end());
  const bool isThick =
      thickest != thickness.end() && static_cast<double>(*thickest) * pixelsAMetre > leastSeen;
  frame.thickness = frame.casterThickness = isThick ? 1.0f : 0.0f;
  const bool hidesVertices = std::all_of(looks.begin(), looks.end(), [&](const PieceLook& look) {
    const bool seesThreads =
        !look.model.weave.empty() && look.settings.threadSpacing * pixelsAMetre > MOST_THREAD_SPACING;
    return look.model.hasVertexLight && !seesThreads;
  });
  isFineForPlain = longestEdge(*cloth) * pixelsAMetre < MOST_PLAIN_DISTANCE;
  lightsVertices =
      options.lightsVertices && hidesVertices && longestEdge(*cloth) * pixelsAMetre < MOST_VERTEX_DISTANCE;
  // At a seam of its texture a mesh has several points at one place, which particles cannot be.
  const bool keepsSeams = !cloth->textureSeams().empty() && !model.blends;
  std::vector<std::uint32_t> steps;
  if (!isRough)
    steps = smoothSteps(*cloth, pixelsAMetre, options);
  else if (keepsSeams)
    steps.assign(cloth->pieces().size(), 1);
  if (clothMesh.hasCuts())  // which are put together anew whenever cloth tears
    for (std::uint32_t& n : steps) n = std::min(n, MOST_CUT_STEPS);
  if (!keepsSeams && std::all_of(steps.begin(), steps.end(), [](std::uint32_t n) { return n == 1; })) {
    smooth.reset();
    return;
  }
  // A relief shows everywhere.
  const bool isLean = options.flatness > 0 && isOfGrids && !model.displaces;
  if (isLean) std::fill(steps.begin(), steps.end(), 2u);
  if (isLean) frame.casterThickness = 0;  // casters are the particles' triangles, which bend elsewhere
  const bool touches = !isRough && scene->solver.selfCollision != SelfCollision::off;
  if (smooth && smooth->steps() == steps && smooth->isLean() == isLean && smooth->hasLayers() == touches)
    return;
  const double layers = touches ? layerDistance(*scene) : 0;
  smooth.emplace(*cloth, steps, isLean, thickness, cuts, layers);
}

void Renderer::Parts::uploadFrame() {
  for (std::size_t i = 0; i < lookBlocks.size(); ++i) {
    shared::RenderFrame own = frame;
    setClothLook(looks[i].settings, own);
    lookBlocks[i].upload(std::span(&own, 1));
  }
  frameBlock.upload(std::span(&frame, 1));
  frameBlock.bindUniform(RENDER_FRAME_BINDING);
}

// Where particles are at the time of an exposure.
GLuint Renderer::Parts::moved(GLuint positions) {
  if (frame.motion == 0 || velocities == 0) return positions;
  if (movedPositions.size() == 0)
    movedPositions = gl::Buffer<glm::vec4>("moved positions", cloth->particleCount());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the solver's last writes
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, MOTION_VELOCITIES_BINDING, velocities);
  movedPositions.bindStorage(SMOOTH_POINTS_BINDING);
  programs.mean().move.bind();
  gl::dispatch(movedPositions.size(), SMOOTH_GROUP);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
  return movedPositions.name();
}

void Renderer::Parts::computeNormals(GLuint positions) {
  clothMesh.computeNormals(
      {programs.normals(clothMesh.hasCuts()), cloth->hasMesh() ? &programs.meshNormals() : nullptr},
      positions);
  clothMesh.followFolds(!smooth && isLitAtVertices() ? &programs.diagonals() : nullptr);
  if (smooth)
    smooth->compute(programs.smooth(), positions, clothMesh,
                    smooth->hasLayers() ? &programs.layers() : nullptr);
  if (!drawsThick()) return;
  if (smooth)
    smooth->computeRim(programs.rim(smooth->isLean()));
  else
    clothMesh.computeRim(programs.rim(false), positions);
}

void Renderer::Parts::drawSurface(GLuint positions, const std::function<void(const PieceLook&)>& choose,
                                  bool meshesAsLines) {
  if (lookBlocks.empty()) {
    choose(looks.front());
    drawPieces(positions, smooth.has_value(), meshesAsLines, {});
    return;
  }
  for (std::size_t i = 0; i < looks.size(); ++i) {
    textures.bind(looks[i].model);
    lookBlocks[i].bindUniform(RENDER_FRAME_BINDING);
    choose(looks[i]);
    drawPieces(positions, smooth.has_value(), meshesAsLines, i);
  }
  frameBlock.bindUniform(RENDER_FRAME_BINDING);
}

void Renderer::Parts::drawPieces(GLuint positions, bool smoothly, bool meshesAsLines,
                                 std::optional<std::size_t> only) {
  if (smoothly)
    smooth->draw(only);
  else
    clothMesh.draw(positions, meshesAsLines, only);
  if (!drawsThick()) return;
  if (smooth)
    smooth->drawRim(only);
  else
    clothMesh.drawRim(only);
}

void Renderer::Parts::drawShadows(GLuint positions) {
  const FlatBounds* const region = part ? &part->shadow : nullptr;
  shadowMap.begin(region);
  if (options.shadows) drawCasters(positions);
  shadowMap.end();
  shadowMap.blurForFloors(programs, region);
}

void Renderer::Parts::drawCasters(GLuint positions) {
  // Shadows are softer than what a lean surface adds to the particles' triangles.
  const bool smoothly = smooth && !smooth->isLean();
  programs.clothShadow.bind();
  if (model.displaces)  // by heights that differ from cloth to cloth
    drawSurface(positions, [](const PieceLook&) {});
  else if (castsCoarsely())
    clothMesh.drawCoarsely(positions);
  else
    drawPieces(positions, smoothly, false, {});
  // A solid's far side alone: its near side would shade itself by rounding.
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  colliders.drawSolids(programs.sphereShadow, programs.shapeShadow);
  glDisable(GL_CULL_FACE);
}

// To a software renderer small triangles cost as much as large ones. The map is read so far off the cloth
// (shadow_place.glsl) that what lies between the rows does not shade it.
bool Renderer::Parts::castsCoarsely() const {
  return options.lightsVertices && !smooth && !drawsThick() && !isExposed() &&
         longestEdge(*cloth) < MOST_COARSE_CASTER * static_cast<double>(shadowMap.texelLength());
}

// Casters are drawn by `shadowFromWorld`, whichever map they go to.
void Renderer::Parts::drawSkyShadows(GLuint positions) {
  for (const ShadowMap& map : skyShadowMaps) {
    frame.shadowFromWorld = map.shadowFromWorld();
    uploadFrame();
    map.begin();
    if (options.shadows) drawCasters(positions);
    map.end();
  }
  frame.shadowFromWorld = shadowMap.shadowFromWorld();
  uploadFrame();
}

// Front to back as far as the order is known, so that hidden fragments are not shaded; what blends comes
// last.
void Renderer::Parts::drawScene(GLuint positions) {
  const ShadedPrograms& shading = programs.shaded(isExposed());
  layBackdrop();
  canvas.bind();
  scissor();
  shadowMap.bindTextures();
  for (std::size_t k = 0; k < SKY_DIRECTIONS; ++k)
    (skyShadowMaps.empty() ? shadowMap : skyShadowMaps[k])
        .bindDepth(SKY_SHADOW_UNIT + static_cast<GLuint>(k));
  const float farthest = 1;
  glClearNamedFramebufferfv(canvas.name(), GL_DEPTH, 0, &farthest);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);

  if (!model.blends) drawCloth(positions);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  colliders.drawSolids(shading.sphere, shading.shape);
  glDisable(GL_CULL_FACE);

  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  // Cloth may lie exactly in a plane, and is seen there: planes count as farther by half a thousandth of
  // their distance.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, planeDepthUnits);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // which says that nothing lies before the stage
  drawPlanes(shading.plane);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_POLYGON_OFFSET_FILL);
  if (model.blends) drawCloth(positions);
  drawFuzz(positions);
  drawOverlay(positions);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

ClothLight Renderer::Parts::lightOf(const PieceLook& look) const {
  if (isExposed()) return ClothLight::exposed;
  if (smooth || !options.lightsVertices) return ClothLight::atPixels;
  if (look.model.isMatte && isFineForPlain) return ClothLight::plain;
  return lightsVertices ? ClothLight::atVertices : ClothLight::atPixels;
}

bool Renderer::Parts::isLitAtVertices() const {
  return std::all_of(looks.begin(), looks.end(), [&](const PieceLook& look) {
    const ClothLight light = lightOf(look);
    return light == ClothLight::plain || light == ClothLight::atVertices;
  });
}

void Renderer::Parts::drawCloth(GLuint positions) {
  // Light at vertices costs less than the depth of what hides it.
  if (!model.blends && !isLitAtVertices()) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    programs.clothDepth.bind();
    drawSurface(positions, [](const PieceLook&) {});
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  drawSurface(
      positions, [&](const PieceLook& look) { programs.cloth(look.model, lightOf(look)).bind(); },
      model.name == "wireframe");  // whose lines are otherwise those of a grid
}

void Renderer::Parts::drawOverlay(GLuint positions) {
  if (view == ViewOptions{}) return;
  const float pinScale = scale < 1 ? 1.6f : 1.0f;  // which few pixels would wash out
  springs.draw(view, programs.overlays(), *cloth, cuts, positions, pinScale);
}

void Renderer::Parts::drawIdentities(GLuint positions) {
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);  // the solver's last positions
  const PickPrograms& picking = programs.picking();
  picking.cloth.bind();
  clothMesh.draw(positions);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  colliders.drawSolids(picking.sphere, picking.shape);
  colliders.drawPlanes(picking.plane);
  glDisable(GL_CULL_FACE);
}

void Renderer::Parts::makeTargets(int width, int height, int shownWidth, int shownHeight) {
  const auto make = [this](gl::Framebuffer& target, const char* label, const gl::FramebufferFormat& format) {
    if (target.format() == format) return;
    target = gl::Framebuffer(label, format);
    changes.forget();
  };
  make(canvas, "canvas",
       {width, height, options.samples, isExposed() ? exposureFormat : canvasFormat, GL_DEPTH_COMPONENT24});
  if (isExposed()) make(mean, "mean of exposures", {.width = width, .height = height, .color = GL_RGBA32F});
  if (isDirect()) return;
  make(finished, "finished", {.width = width, .height = height, .color = GL_RGBA8});
  if (stretchesApart())
    make(stretched, "stretched", {.width = shownWidth, .height = shownHeight, .color = GL_RGBA8});
}

void Renderer::Parts::findChanges(GLuint positions, int width, int height) {
  part.reset();
  underShadows.reset();
  // Heights move the surface away from the particles.
  if (!options.keepsStill || model.displaces || isExposed() || cloth->particleCount() > mostReadBack)
    return changes.forget();
  std::vector<glm::vec4> particles(cloth->particleCount());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // the solver's last writes
  glGetNamedBufferSubData(positions, 0, static_cast<GLsizeiptr>(particles.size() * sizeof(glm::vec4)),
                          particles.data());
  float reach = smooth ? static_cast<float>(longestEdge(*cloth)) : 0;
  if (drawsThick()) reach += *std::max_element(thickness.begin(), thickness.end());
  reach += longestFuzz();
  const ChangedArea::View seen{frame.clipFromWorld, frame.shadowFromWorld, width, height, reach};
  const auto place = ChangedArea::placeOf(*cloth, particles, seen);
  if (!place) return changes.forget();
  part = changes.next(seen, *place, colliders);
  for (const PlaneDisc& plane : colliders.discs())
    if (isGroundBehind(plane))
      underShadows = ChangedArea::shadowsOn(plane, seen, *place, particles, colliders);
}

void Renderer::Parts::scissor() const {
  if (!part) return;
  glEnable(GL_SCISSOR_TEST);
  glScissor(part->picture.left, part->picture.bottom, part->picture.width(), part->picture.height());
}

PixelRect Renderer::Parts::drawnPart() const {
  return part ? part->picture : PixelRect{0, 0, canvas.format().width, canvas.format().height};
}

void Renderer::Parts::draw(const Picture& picture, const Around& around) {
  const auto [state, camera, time, target, width, height, over, exposure, number] = picture;
  if (width <= 0 || height <= 0) return;  // a minimised window
  const auto scaled = [&](int size) { return std::max(1, static_cast<int>(std::lround(scale * size))); };
  const int w = scaled(width), h = scaled(height);
  const DrawnOver wanted = over == nullptr ? DrawnOver{} : DrawnOver{over->colorTexture(), {width, height}};
  if (std::exchange(drawnOver, wanted) != wanted) changes.forget();
  const double motion = exposure != nullptr ? scene->camera.shutter * exposure->time : 0;
  frame.motion = static_cast<float>(motion);
  shellPlace = exposure != nullptr ? std::fmod(0.5 + number * 0.6180339887498949, 1.0) : 0.5;
  colliders.place(*scene, stage, time + motion);
  const double aspect = static_cast<double>(width) / height;
  lookFrom(*camera, w, h, aspect);
  if (exposure != nullptr || isExposed()) shineFrom(exposure);
  if (exposure != nullptr) lookThrough(*exposure, *camera);
  chooseSurface(*camera, h, aspect);
  uploadFrame();
  textures.bind(model);
  makeTargets(w, h, width, height);
  const GLuint positions = moved(state);
  findChanges(positions, w, h);
  if (number == 0 || positions != state) around("normals", [&] { computeNormals(positions); });
  around("shadows", [&] { drawShadows(positions); });
  if (exposure != nullptr) around("shadows of the sky", [&] { drawSkyShadows(positions); });
  around("backdrop", [&] { drawBackdrop(w, h); });
  around("scene", [&] { drawScene(positions); });
  if (exposure != nullptr) around("mean", [&, n = number] { addToMean(n == 0); });
  around("resolve", [&, t = isDirect() ? target : finished.name(), exposes = exposure != nullptr] {
    if (exposes)
      resolveInto(t, w, h, programs.mean().show, mean.colorTexture());
    else
      finishInto(t, w, h);
  });
  if (stretchesApart() || isOver()) around("stretch", [&] { stretch(); });
  if (!isDirect() && !isOver())
    around("show",
           [&, t = target, fullWidth = width, fullHeight = height] { show(t, fullWidth, fullHeight); });
}

}  // namespace clothsim
