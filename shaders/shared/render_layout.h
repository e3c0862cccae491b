// What the renderer's C++ and GLSL share: bindings, attribute locations and the uniform block of a frame.
// Rows of 16 bytes; colours are linear RGB.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace clothsim::shared {
using glm::mat4;
using glm::vec4;
using uint = unsigned int;
#endif

// Bound anew before every use, since the simulation has the same slots for itself.
#define RENDER_FRAME_BINDING 8       // uniform block RenderFrame
#define CLOTH_GRID_BINDING 9         // uniform block ClothGrid
#define NORMALS_POSITIONS_BINDING 0  // storage block, vec4 a particle
#define NORMALS_OUT_BINDING 1        // storage block, vec4 a particle
#define TANGENTS_OUT_BINDING 3       // storage block, vec4 a particle
#define REST_POSITIONS_BINDING 4     // storage block, vec4 a particle
#define MESH_COORDINATES_BINDING 6   // storage block, vec2 a particle: texture coordinates
// The passes of the smooth surface (src/render/smooth_surface.h), a vec4 a point unless said otherwise.
#define SMOOTH_CONTROLS_BINDING 7
#define SMOOTH_POINTS_BINDING 2
#define SMOOTH_NORMALS_BINDING 4
#define SMOOTH_TANGENTS_BINDING 5
#define SMOOTH_PLACES_BINDING 6   // a word a point: the point at whose place it is drawn
#define SMOOTH_MIDDLES_BINDING 0  // three words a point between two others: it, and those, the kept one first
#define SMOOTH_COUNTS_BINDING 1   // a word for each work group
#define SMOOTH_KEPT_BINDING 2     // three words a triangle
#define SMOOTH_COMMAND_BINDING 3  // of glDrawElementsIndirect
#define RIM_CORNERS_BINDING \
  6  // four words a corner: the point before it, it, the one after it, the bits of the radius
#define RIM_PLACES_BINDING 7    // as SMOOTH_PLACES_BINDING
#define RIM_POINTS 6            // of a rim at each corner; the middle is there twice
#define PATCH_POINTS_BINDING 6  // eight words a point: PatchPoint of src/render/patches.h
#define CUT_CORNERS_BINDING 6   // four words a corner: the particle before it, it, the one after it, nothing
#define MOTION_VELOCITIES_BINDING 1  // a vec4 a particle
#define DIAGONALS_BINDING 2          // six words a cell: two triangles
// Passes that look for layers near each other (src/render/layer_shares.h).
#define LAYER_SEARCH_BINDING 10    // uniform block LayerSearch
#define LAYER_TRIANGLES_BINDING 2  // three words a triangle
#define LAYER_ENTRIES_BINDING 1    // a vec4 a triangle
#define LAYER_HEADS_BINDING 3      // a word a bucket
#define LAYER_BULGES_BINDING \
  4                           // a vec4 a triangle: way of the smooth surface from its middle, and its length
#define LAYER_REST_BINDING 5  // a vec4 a particle
#define LAYER_BEFORE_BINDING 6   // a float a particle
#define LAYER_SHARES_BINDING 7   // a float a particle
#define SMOOTH_SHARES_BINDING 6  // the same where the smooth surface of a grid is made,
#define PATCH_SHARES_BINDING 7   // and of triangles
#define LAYERS_APART 2.5         // in the cloth, or nothing is another layer [cells]
#define SMOOTH_GROUP 64          // invocations of a work group
#define SHADOW_MAP_UNIT 0        // texture units
#define FLOOR_SHADOW_UNIT 1
#define CANVAS_UNIT 2
#define CUTS_BINDING 2  // storage block, a word a particle: which of its springs are cut (cloth/cuts.h)
#define WEAVE_UNIT 3
#define PRINT_UNIT 4
#define HEIGHTS_UNIT 5
#define ENVIRONMENT_UNIT 6
#define BACKDROP_UNIT 7
#define SKY_SHADOW_UNIT 8          // and those behind it: SKY_DIRECTIONS
#define GROUND_UNIT 12             // the picture of the stage's ground
#define NORMALS_POSITIONS_UNIT 13  // buffer textures of the normals passes: a texel a particle,
#define MESH_CORNERS_UNIT 14       // and a texel a word of src/render/mesh_neighbours.h
#define SKY_DIRECTIONS 4           // of an exposure (src/render/exposure.h)
#define FLOOR_SHADOW_SIZE 256      // [texels] of the blurred shadow for floors
#define HALF_TABLE_LENGTH 1.30     // of the stages' grounds [sizes of the scene]
#define HALF_TABLE_DEPTH 0.92
#define TABLE_CORNER 0.09
#define ROOM_RADIUS 2.1
#define EDGE_MIDDLES_BINDING 0  // storage blocks of src/render/edges.h: a vec2 a tile, and
#define EDGE_COMMAND_BINDING 1  // of glDrawArraysIndirect
#define EDGE_TILES_UNIFORM 0    // ivec4
#define EDGE_TILE 8             // [pixels] along each side
#define MESH_NORMALS_GROUP 64   // particles of a mesh in a work group
#define MESH_RING 8u            // particles around one that say how deep it lies in a fold
#define NORMALS_GROUP_SIZE 8    // work groups of 8 x 8 particles

#define POSITION_LOCATION 0  // vertex attributes
#define NORMAL_LOCATION 1
#define TEXTURE_COORDINATE_LOCATION 2
#define INSTANCE_PLACE_LOCATION 3   // sphere: centre, radius; plane: centre of the drawn part, its radius
#define INSTANCE_NORMAL_LOCATION 4  // plane: normal
#define INSTANCE_ROWS_LOCATION 5    // and 6, 7. Other shapes: the rows that take their own frame to the world
#define INSTANCE_COLLIDER_LOCATION 8  // index of the collider; -1: of none
#define INSTANCE_LOOK_LOCATION 11     // colliders: linear colour and gloss; red below 0: the stage's ground
#define TANGENT_LOCATION 10           // cloth: the direction of u, and the strain
#define LINE_LOOK_LOCATION 9          // springs: sRGB colour and width [pixels], the same for all
#define FUZZ_SHELL_UNIFORM \
  0  // vec3: height of a shell of fuzz and its depth, as parts of the fibres, and how far it is seen

#define PICK_KIND_BITS 2  // of a picked pixel's identity; the rest is a number
#define PICK_KIND_MASK 3u
#define PICK_NOTHING 0u
#define PICK_CLOTH 1u     // number of a particle
#define PICK_COLLIDER 2u  // index of a collider

#define STRAIN_STOPS 7
#define STAGE_SIZES 4.5  // how far a stage's ground reaches, in sizes of the scene

struct RenderFrame {
  mat4 clipFromWorld;
  mat4 shadowFromWorld;                     // to the shadow map, 0 to 1 in each coordinate
  mat4 skyShadowFromWorld[SKY_DIRECTIONS];  // the same for the light of the sky from `toSky`
  vec4 eye;                                 // xyz [m]
  vec4 toKeyLight;                          // xyz, unit; w: size of a texel of the shadow map [m]
  vec4 toSky[SKY_DIRECTIONS];  // xyz, unit; w: as of toKeyLight. 0: this is no exposure of a mean
  vec4 toFillLight;            // xyz, unit
  vec4 keyColor;               // radiance times pi, so that a white matte surface facing the light returns it
  vec4 fillColor;
  vec4 skyColor;     // ambient light from above
  vec4 bounceColor;  // ambient light from below
  vec4 clothFront;   // albedo
  vec4 clothBack;
  vec4 floorColor;
  vec4 stagePlace;  // the middle of the ground [m]; w: how far from there it fades out
  vec4 ground;  // of the stage: x: repeats of its picture in a metre, y: how far the picture shows, 0 to 1,
                // z: gloss, w: 1 where the scene has a ground
  vec4 backgroundTop;
  vec4 backgroundBottom;
  vec4 backgroundGlow;  // added around the middle of the picture; w: how much darker its corners are
  vec4 backgroundPlain;
  vec4 pixels;     // width, height, 1 / width, 1 / height
  vec4 rayMiddle;  // the direction in which the middle of the picture lies, and how it changes
  vec4 rayRight;   // from there to the right edge
  vec4 rayUp;      // and to the upper one
  vec4 fabric;     // x, y: repeats of the weave's picture in a metre along u and v, z: gloss, w: sheen
  vec4 yarns;      // x, y: threads in a repeat along u and v, z: how far their dye differs, w: 1 of a knit
  vec4 weft;       // albedo; w: 1 where it is not that of the warp
  vec4 relief;  // x: strength of normals, y: height of height maps [m], z: repeats of a texture, w: gloss of
                // the reverse over that of the face
  vec4 irradiance[9];              // of the sky (render/environment.h)
  vec4 strainStops[STRAIN_STOPS];  // colours from the most compressed to the most stretched
  float strainRange;               // l/L - 1 at the last of them
  float flatness;                  // how far triangles may lie beside the smooth surface [pixels]
  float thickness;                 // 1: cloth is drawn as thick as it is; 0: without thickness
  float casterThickness;           // the same where its shadow falls from
  float motion;                    // from the state to where it is drawn [s]
  float fuzz;                      // how far loose fibres stand off the cloth [m]
  float fuzzCover;                 // their optical depth, seen from straight ahead
  float pile;                      // 1: the front is one of upright fibres
};

struct ClothPiece {
  uint firstParticle, columns, rows;
  uint ring;     // how many points away the cloth is looked at for the shade in folds; 0: a mesh
  float width;   // at rest [m], along u; of a mesh the length of a unit of u
  float height;  // along v
  float longer;  // the larger of the two
  float reach;   // length of the ring's steps at rest [m]
  float front;   // -1 where rows go up on the front (a standing sheet), else 1
  uint steps;    // of the smooth surface on each side of a cell
  uint firstPoint, firstControl;  // of this piece there
  float halfThickness;            // of what is drawn [m]
  float hasLayers;                // 1: the smooth surface leaves the triangles as far as other layers let it
  uint firstTriangle, triangles;  // of this piece, among all, where it has layers
};

struct LayerSearch {
  uint triangles;
  uint buckets;          // a power of two
  float perBucket;       // of their side [1/m]
  float radius;          // half of it: what counts is nearer, from center to center [m]
  float centerToCorner;  // of a triangle, at most [m]
  float leastBulge;      // on average of two triangles, or they stay apart in any case [m]
  float unused1, unused2;
};

#ifdef __cplusplus
}  // namespace clothsim::shared
#endif
