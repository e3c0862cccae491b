// What `clothsim describe` calls live is what a running simulation takes: with the bits of a scene that had
// it from the start.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "scene_io/describe.h"
#include "scene_io/scene_io.h"
#include "session/carry_over.h"
#include "simulation/simulation.h"
#include "support/scene_text.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

// Two sheets, of a fabric and of springs, that are sewn together, over a collider of each shape. The meshes
// are closed; a particle begins just inside of the first ones.
Scene sceneWithAll(const std::string& meshes) {
  return test::sceneOf(R"({
    "cloths": [
      {"width": 0.5, "height": 0.5, "num_width_points": 4, "num_height_points": 4, "material": {"damping": 1},
       "pinned": ["left"],
       "pin_motion": [{"pinned": ["left"], "keys": [{"t": 0}, {"t": 1, "position": [0, 1, 0.3]}]}]},
      {"width": 0.5, "height": 0.5, "num_width_points": 4, "num_height_points": 4, "position": [0.55, 0, 0],
       "ks": 500, "pinned": ["right"]}],
    "seams": [{"a": {"cloth": 0, "points": ["right"]}, "b": {"cloth": 1, "points": ["left"]}, "time": 0.1}],
    "colliders": [
      {"type": "sphere", "origin": [0.2, 0.85, 0.2], "radius": 0.149,
       "motion": {"keys": [{"t": 0, "position": [0.2, 0.85, 0.2]}, {"t": 1, "position": [0.2, 1.85, 0.2]}]}},
      {"type": "plane", "point": [0, 0.5, 0], "normal": [0, 1, 0]},
      {"type": "capsule", "origin": [0.4, 0.9, 0.3], "axis": [1, 0, 0], "length": 0.1, "radius": 0.09},
      {"type": "box", "origin": [0.7, 0.95, 0.2], "size": [0.1, 0.1, 0.1]},
      {"type": "torus", "origin": [0.8, 0.95, 0.3], "radius": 0.1, "tube_radius": 0.05},
      {"type": "cylinder", "origin": [0.1, 0.95, 0.4], "radius": 0.05, "height": 0.1},
      {"type": "cone", "origin": [0.9, 0.95, 0.1], "radius": 0.05, "height": 0.1},
      {"type": "mesh", "file": ")" +
                       meshes + R"(", "shapes": 2, "shapes_per_second": 60, "shapes_start": -0.02,
       "origin": [0.6867, 0.96, 0.3083], "scale": 0.1, "cells": 8}],
    "wind": {"velocity": [1, 0, 2], "gust": {"strength": 1}},
    "attractors": [{"position": [0.5, 2, 0.5], "strength": 1, "radius": 2}],
    "solver": {"integrator": "implicit", "simulation_steps": 1, "frames_per_sec": 60, "friction_law": "coulomb",
               "self_collision": "contact", "strain_limit": false, "newton_steps": 5, "cg_iterations": 10},
    "expect": {"frames": 5}})");
}

const std::vector<std::string> settings{
    R"(schema="clothsim/1")",
    "name=other",
    "description=other",
    "cloth.material.damping=9",
    "cloth.material.friction=0.1",
    "cloths.1.damping=8",
    "cloth.pressure=4",
    "cloth.tear_strain=0.0001",
    R"(cloth.pin_motion={"keys": [{"t": 0}, {"t": 1, "position": [0, 2, 0.3]}]})",
    R"(cloth.pin_motion.0.keys=[{"t": 0}, {"t": 1, "position": [0, 3, 0.3]}])",
    "cloth.pin_motion.0.keys.1.t=0.5",
    "cloth.pin_motion.0.keys.1.position=[0.1, 1, 0]",
    "cloth.pin_motion.0.keys.1.rotation=[0, 90, 0]",
    "cloth.pin_motion.0.loop=true",
    "cloth.pin_motion.0.interpolation=cubic",
    R"(cloth.pin_motion=[{"pinned": ["left"], "collider": 0}])",
    R"(cloth.pin_motion.0.pinned=[[0, 0]])",
    R"(cloth.render={"gloss": 0.9})",
    "cloth.render.color=[0, 0, 1]",
    "cloth.render.back_color=[0, 0, 1]",
    "cloth.render.texture=quilt",
    "cloth.render.texture_repeat=3",
    "cloth.render.weave=denim",
    "cloth.render.thread_spacing=0.004",
    "cloth.render.gloss=0.8",
    "cloth.render.fuzz=0.003",
    "cloth.render.normal_strength=0.5",
    "cloth.render.height=0.02",
    "cloth.render.thickness=0.004",
    "seams.0.time=0.2",
    R"(colliders=[{"type": "plane", "point": [0, 0.9, 0], "normal": [0, 1, 0]}])",
    R"(colliders.5={"type": "capsule", "origin": [0.1, 0.95, 0.4], "radius": 0.05, "length": 0.1})",
    "colliders.6.type=cylinder",
    "colliders.3.origin=[0.7, 0.96, 0.2]",
    "colliders.0.radius=0.12",
    "colliders.0.friction=0.9",
    R"(colliders.3.motion={"keys": [{"t": 0}, {"t": 1, "position": [0.7, 2, 0.2]}]})",
    R"(colliders.0.motion.keys=[{"t": 0, "position": [0.2, 0.85, 0.2]}])",
    "colliders.0.motion.keys.1.t=0.5",
    "colliders.0.motion.keys.1.position=[0.2, 1.5, 0.2]",
    "colliders.0.motion.keys.1.rotation=[0, 500, 0]",
    "colliders.0.motion.loop=true",
    "colliders.0.motion.interpolation=cubic",
    R"(colliders.0.render={"gloss": 0.9})",
    "colliders.0.render.color=[0, 0, 1]",
    "colliders.0.render.gloss=0.8",
    "colliders.1.point=[0, 0.9, 0]",
    "colliders.1.normal=[0.1, 1, 0]",
    "colliders.2.axis=[0, 1, 0]",
    "colliders.2.length=0.3",
    "colliders.3.size=[0.2, 0.12, 0.1]",
    "colliders.3.rotation=[0, 45, 0]",
    "colliders.3.rounding=0.02",
    "colliders.4.tube_radius=0.06",
    "colliders.7.file=FOLDER/wide_%d.obj",
    "colliders.7.shapes=3",
    "colliders.7.first_shape=1",
    "colliders.7.shapes_per_second=12",
    "colliders.7.shapes_start=1",
    "colliders.7.shapes_loop=true",
    "colliders.7.scale=0.2",
    "colliders.7.cells=9",
    "colliders.6.height=0.2",
    "colliders.6.top_radius=0.02",
    R"(plane={"point": [0, 0.9, 0], "normal": [0, 1, 0]})",
    R"(sphere={"origin": [0.3, 0.9, 0.3], "radius": 0.1})",
    "gravity=[1, -5, 0]",
    R"(wind={"velocity": [3, 0, 0]})",
    "wind.velocity=[3, 0, 0]",
    R"(wind.gust={"strength": 3})",
    "wind.gust.strength=3",
    "wind.gust.frequency=3",
    "wind.gust.seed=3",
    "wind.drag=2",
    "wind.lift=1",
    "wind.air_density=2",
    "air_resistance=0.01",
    "attractors=[]",
    "attractors.0.position=[0, 2, 0]",
    "attractors.0.strength=-1",
    "attractors.0.radius=3",
    R"(solver={"integrator": "implicit", "simulation_steps": 3})",
    "solver.integrator=bdf2",
    "solver.tolerance=0.001",
    "solver.newton_steps=2",
    "solver.cg_iterations=3",
    "solver.frames_per_sec=50",
    "solver.simulation_steps=3",
    "solver.strain_limit=0.01",
    "solver.self_collision=false",
    "solver.self_friction=0.9",
    "solver.friction_law=cs184",
    "solver.max_speed=500",
    "solver.max_strain=50",
    R"(camera={"fov": 20})",
    "camera.position=[0, 1, 5]",
    "camera.target=[0, 1, 0]",
    "camera.fov=25",
    "camera.aperture=0.01",
    "camera.shutter=0.01",
    "camera.focus=3",
    R"(render={"gloss": 0.9})",
    "render.shader=phong",
    "render.color=[0, 0, 1]",
    "render.back_color=[0, 0, 1]",
    "render.texture=quilt",
    "render.texture_repeat=3",
    "render.weave=denim",
    "render.thread_spacing=0.004",
    "render.gloss=0.8",
    "render.fuzz=0.003",
    "render.normal_strength=0.5",
    "render.height=0.02",
    "render.strain_range=0.2",
    "render.light=[0, 1, 0]",
    "render.light_size=20",
    "render.stage=table",
    "render.background=plain",
    "render.background_color=[0, 0, 1]",
    "render.thickness=0.004",
    "render.smooth=false",
    "render.ground=false",
    R"(expect={"frames": 6})",
    "expect.frames=6",
    "expect.centroid=[0, 1, 0]",
    "expect.centroid_tolerance=0.1",
    "expect.min_y=[0, 1]",
    "expect.max_strain=[0, 1]",
    "expect.kinetic_energy=[0, 1]",
    "expect.max_penetration=[0, 1]",
    "expect.crossings=[0, 1]",
};

// "cloths.1.render.gloss=1" as describe names it: "cloth.render.gloss".
std::string describedKey(const std::string& setting) {
  std::string key;
  for (const char c : setting.substr(0, setting.find('=')) + ".") {
    if (c != '.' || !key.ends_with('.')) key += c;
    const std::size_t dot = key.substr(0, key.size() - 1).find_last_of('.');
    if (c != '.' || dot == std::string::npos) continue;
    const std::string last = key.substr(dot + 1, key.size() - dot - 2);
    if (last.find_first_not_of("0123456789") == std::string::npos) key = key.substr(0, dot) + "[].";
  }
  key.pop_back();
  const std::string cloths = "cloths[]";
  return key.starts_with(cloths) ? "cloth" + key.substr(cloths.size()) : key;
}

class LiveKeys : public testing::Test {
 protected:
  LiveKeys() {
    for (int shape = 0; shape < 3; ++shape) {
      const std::string number = std::to_string(shape);
      writeTetrahedron("body_" + number + ".obj", 1, 1 + 0.1 * shape);
      writeTetrahedron("wide_" + number + ".obj", 1.5, 1 + 0.1 * shape);
    }
    scene_ = sceneWithAll((folder_ / "body_%d.obj").string());
  }

  void writeTetrahedron(const std::string& name, double width, double height) const {
    std::ofstream(folder_ / name) << "v 0 0 0\nv " << width << " 0 0\nv 0 " << height
                                  << " 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  }

  [[nodiscard]] Scene with(std::string setting) const {
    const std::string folder = "FOLDER";
    if (const std::size_t at = setting.find(folder); at != std::string::npos)
      setting.replace(at, folder.size(), folder_.path().string());
    Scene changed = scene_;
    setSceneValue(changed, setting);
    return changed;
  }

  test::TemporaryFolder folder_;
  Scene scene_;
};

std::string hashAfterTwoFrames(Simulation& simulation) {
  simulation.solver().convertVelocities();
  simulation.stepFrames(2);
  return hashText(stateHash(simulation.state()));
}

TEST_F(LiveKeys, AreThoseThatDescribeCallsSo) {
  std::set<std::string> untried;
  for (const FieldInfo& field : describeFields())
    if (field.live) untried.insert(field.path);
  for (const std::string& setting : settings) {
    const Scene changed = with(setting);
    const std::string key = describedKey(setting);
    EXPECT_TRUE(changed != scene_ || key == "schema") << setting << " changes nothing";
    EXPECT_FALSE(needsRebuild(scene_, changed)) << setting;
    untried.erase(key);
  }
  untried.erase("cloth.pin_motion[].collider");  // with it go the keys: settings of the whole path try it
  for (const std::string& key : untried) ADD_FAILURE() << "no setting tries " << key;
}

TEST_F(LiveKeys, ActAsInASceneThatHadThemFromTheStart) {
  Simulation plain(scene_);
  const std::string before = hashAfterTwoFrames(plain);
  std::set<std::string> without;
  for (const std::string& setting : settings) {
    const Scene changed = with(setting);
    const std::string key = describedKey(setting), group = key.substr(0, key.find('.'));
    if (group == "render" || group == "camera" || group == "expect" || key.starts_with("cloth.render."))
      continue;  // moves no cloth
    Simulation fromTheStart(changed), live(scene_);
    live.configure(changed);
    const std::string after = hashAfterTwoFrames(live);
    EXPECT_EQ(after, hashAfterTwoFrames(fromTheStart)) << setting;
    if (after == before) without.insert(key);
  }
  for (const char* acts :
       {"cloth.pressure", "cloth.tear_strain", "cloth.material.damping", "cloth.damping", "seams[].time",
        "colliders[].file", "colliders[].shapes", "colliders[].first_shape", "colliders[].shapes_loop"})
    EXPECT_FALSE(without.contains(acts)) << acts << " has no effect in this scene";
}

TEST_F(LiveKeys, OfPathsThatLetGoAreThoseThatLeaveThePinsAndTheirKeys) {
  setSceneValue(scene_, R"(cloth.pin_motion={"pinned": ["left"], "keys": [
      {"t": 0}, {"t": 0.01, "position": [0, 1, 0.3], "free": true}, {"t": 1, "position": [0, 1, 0.3]}]})");
  for (const char* setting :
       {"cloth.pin_motion.0.keys.1.t=0.03", "cloth.pin_motion.0.keys.1.position=[0.1, 1, 0]",
        "cloth.pin_motion.0.keys.1.rotation=[0, 90, 0]", "cloth.pin_motion.0.loop=true",
        "cloth.pin_motion.0.interpolation=cubic"}) {
    const Scene changed = with(setting);
    EXPECT_FALSE(needsRebuild(scene_, changed)) << setting;
    Simulation fromTheStart(changed), live(scene_);
    live.configure(changed);
    EXPECT_EQ(hashAfterTwoFrames(live), hashAfterTwoFrames(fromTheStart)) << setting;
  }
  for (const char* setting :
       {R"(cloth.pin_motion=[{"pinned": ["left"], "collider": 0}])", "cloth.pin_motion.0.pinned=[[0, 0]]",
        R"(cloth.pin_motion.0.keys=[{"t": 0}, {"t": 1, "free": true}])"})
    EXPECT_TRUE(needsRebuild(scene_, with(setting))) << setting;
}

TEST_F(LiveKeys, AreNotThoseOfWhichAClothIsMade) {
  for (const char* setting :
       {"cloth.num_width_points=7", "cloth.material.stretch=500", "cloth.material.density=0.3",
        "cloths.1.ks=600", R"(cloth.pinned=["left", "top"])", "cloth.pin_motion.0.release=2",
        "cloth.pin_motion.0.keys.1.free=true", "seams=[]", "seams.0.stiffness=50", "seams.0.a.reverse=true",
        R"(seams.0.b.points=["top"])"}) {
    EXPECT_TRUE(needsRebuild(scene_, with(setting))) << setting;
    const std::string key = describedKey(setting);
    for (const FieldInfo& field : describeFields()) EXPECT_FALSE(field.live && field.path == key) << key;
  }
}

}  // namespace
}  // namespace clothsim
