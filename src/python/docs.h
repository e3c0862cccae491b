// The docstrings of the Python package: shapes, units, and what is raised.
#pragma once

namespace clothsim::docs {

inline constexpr const char* simulation =
    R"(A cloth being simulated: one scene on one backend.

scene       name of a bundled scene (clothsim.scenes()), a path to a scene file, or a dict
            with the keys of a scene file
backend     "auto", "cpu" or "gpu"; all give the same bits. "auto" takes the GPU where
            OpenGL 4.5 is hardware
resolution  (columns, rows) of the scene's grids, as `clothsim run --resolution`
jitter      free particles start displaced at random by up to this along each axis [m]
seed        of the jitter
settings    any key of the scene: **{"cloth.ks": 500, "wind.velocity": [0, 0, 4]};
            `clothsim describe` lists them

Raises SceneError, UsageError, OpenGlError with the messages of the program. One thread at a
time may use it; once it uses OpenGL, only the thread that made it.)";

inline constexpr const char* step =
    R"(Advances by so many time steps, of which `solver.simulation_steps` make a frame.

Other Python threads run meanwhile. Ctrl-C ends it after a whole step with KeyboardInterrupt.
Raises SimulationError when the cloth blows up; the state is then the one before that frame,
or before the steps where they were less.)";

inline constexpr const char* stepFrames =
    R"(Advances by so many frames, 1 / `solver.frames_per_sec` seconds each; otherwise as step().)";

inline constexpr const char* run =
    R"(Advances by so many frames and measures at the beginning and after each.

Returns a dict of float64 arrays of frames + 1 entries: the columns of
`clothsim run --trace`. Energies are in J, momenta in kg m/s, lengths in m.)";

inline constexpr const char* reset =
    R"(Back to the start of the scene as it was given; pins, edits and counts are gone.

seed: another one for the jitter; None takes that of the constructor. Arrays got before show
the state before: ask for new ones.)";

inline constexpr const char* time = "Simulated time [s].";
inline constexpr const char* frame = "Frames that fit into `time`, rounded.";
inline constexpr const char* backend = "\"cpu\" or \"gpu\".";
inline constexpr const char* device = "Name of the device, for display.";
inline constexpr const char* remarks =
    R"(What the program would tell on stderr about the scene and the state that was loaded last: sentences.)";

inline constexpr const char* positions =
    R"(Positions [m]: float32, shape (particles, 3), row by row of the grids; read-only.

On the CPU backend a view of the simulation's own memory: no copy, the same address every time,
and it shows the current state after each step until reset(). While such a view is kept, a call
of step() may copy the state once to leave it there. On the GPU a copy.

Assign to write: sim.positions = array. What is not finite is refused (UsageError).)";

inline constexpr const char* velocities =
    R"(Velocities [m/s]: float32, shape (particles, 3), as `positions`.

Under the integrator verlet those of half a step before, as the scheme carries them; energies in
measures() and run() are of the velocities at `time`. Assign to write.)";

inline constexpr const char* forces =
    R"(Forces from outside on each particle [N]: float32, shape (particles, 3), a copy.

Assign an array: from the next step on it acts beside the scene's own forces, the same in every step,
until another one or None is assigned, or reset(). Pinned particles stay. States do not hold it.)";

inline constexpr const char* pins =
    R"(Which particles are pinned: bool, shape (particles,), a copy.

Assign booleans to pin and free: what changes is at rest where it is, and leaves any path of the scene.)";

inline constexpr const char* inverseMasses =
    R"(Inverse masses [1/kg]: float32, shape (particles,), 0 where pinned; read-only, as `positions`.)";

inline constexpr const char* faces =
    R"(Triangles that are left now (cloth may tear): uint32, shape (triangles, 3), indices of particles,
counterclockwise seen from the front.)";

inline constexpr const char* stateHash =
    R"(FNV-1a over positions and velocities, 16 hex digits: `state_hash` of `clothsim run --json`.)";

inline constexpr const char* colliderPositions =
    R"(Where the colliders are now: a list of (x, y, z) [m], in the order of the scene.)";

inline constexpr const char* moveCollider =
    R"(Moves a collider straight to a position [m] within so many seconds (None: one frame).

It stays there and leaves any path of the scene. Friction sees its velocity.)";

inline constexpr const char* turnCollider =
    R"(Turns a collider about its origin or point within so many seconds (None: one frame).

turn: a rotation vector, axis times angle, at most 180 long [degrees]. It stays turned and leaves any
path of the scene. Friction sees it turn.)";

inline constexpr const char* set =
    R"(Changes keys of the scene from the next step on: sim.set(**{"wind.velocity": [0, 0, 4]}).

Raises UsageError for keys that make another cloth, as cloth.width.)";

inline constexpr const char* scene = "The scene as it is now: a dict with the keys of a scene file.";

inline constexpr const char* measures =
    R"(Measures of the state: a dict with the names of `clothsim run --json`.

Peaks and warnings count the frames that were measured: the start, those of run(), and those at
which measures() was called.)";

inline constexpr const char* render =
    R"(A picture as `clothsim render` draws it: uint8, shape (height, width, 3), RGB, top row first.

view: (right, up, zoom) turns the camera, in degrees, and zooms in. exposures: of how many the
picture is the mean; the program takes 64 for a still. Needs OpenGL 4.5, also on the
CPU backend (OpenGlError).)";

inline constexpr const char* save =
    R"(Writes the state to a file; the extension chooses .csv, .ply, .obj, .glb, .npz or .state (exact).)";

inline constexpr const char* load = R"(Continues from a .state file of a cloth with as many particles.)";

inline constexpr const char* getState = R"(The exact state, as the bytes of a .state file.)";
inline constexpr const char* setState = R"(Continues from what get_state() returned.)";
inline constexpr const char* scenes = "Names of the bundled scenes.";
inline constexpr const char* setThreads =
    "Threads of the CPU backend, 1 to 256, for all simulations of the process; the bits stay the same.";

}  // namespace clothsim::docs
