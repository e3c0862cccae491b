// The extension module clothsim._clothsim: translates between Python and PythonSimulation.
#include <dlfcn.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/files.h"
#include "core/thread_team.h"
#include "export/formats.h"
#include "python/docs.h"
#include "python/python_simulation.h"
#include "python/released_lock.h"
#include "scene_io/scene_io.h"

namespace py = pybind11;

// An object that __new__() made without __init__() has no simulation; pybind11 would give memory without one.
template <>
struct pybind11::detail::type_caster<clothsim::PythonSimulation>
    : type_caster_base<clothsim::PythonSimulation> {
  bool load(handle source, bool convert) {
    if (isinstance<clothsim::PythonSimulation>(source) &&
        !reinterpret_cast<instance*>(source.ptr())->get_value_and_holder().holder_constructed())
      throw type_error(
          "this clothsim.Simulation holds no simulation, since its __init__() has not made one; make it by "
          "clothsim.Simulation(...)");
    return type_caster_base<clothsim::PythonSimulation>::load(source, convert);
  }
};

namespace clothsim {
namespace {

using Holder = std::shared_ptr<PythonSimulation>;
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

// A value as scene files have it: numbers, text, lists, and whatever has tolist(), as NumPy's arrays.
std::string jsonOf(const py::handle& value) {
  const py::cpp_function plain([](const py::object& other) { return other.attr("tolist")(); });
  return py::str(py::module_::import("json").attr("dumps")(value, py::arg("default") = plain));
}

std::vector<std::string> settingsOf(const py::kwargs& values) {
  std::vector<std::string> settings;
  for (const auto& [key, value] : values) settings.push_back(std::string(py::str(key)) + "=" + jsonOf(value));
  return settings;
}

// Two whole numbers.
GridSize sizeOf(const py::object& resolution) {
  try {
    const auto [columns, rows] = resolution.cast<std::pair<int, int>>();
    return {columns, rows};
  } catch (const py::cast_error&) {
    throw UsageError("resolution: expected two whole numbers, as (64, 48), found " +
                     std::string(py::repr(resolution)));
  }
}

void setThreads(int threads) {
  if (threads < 1 || threads > ThreadTeam::MOST_THREADS)
    throw UsageError("set_threads: expected 1 to " + std::to_string(ThreadTeam::MOST_THREADS) + ", found " +
                     std::to_string(threads));
  ThreadTeam::setSharedThreads(threads);
}

// A name, a path or a dict.
RemarkedScene readAny(const py::object& scene, const py::object& resolution, const py::kwargs& values) {
  SceneOptions options;
  options.settings = settingsOf(values);
  if (!resolution.is_none()) options.resolution = sizeOf(resolution);
  if (py::isinstance<py::dict>(scene)) return changedScene(parseScene(jsonOf(scene), "the dict"), options);
  options.scene = py::str(py::module_::import("os").attr("fspath")(scene));
  return readScene(options);
}

// Steps let other threads of Python run; Ctrl-C ends them.
void poll() {
  std::optional<py::gil_scoped_acquire> lock;
  takeLock([&] { lock.emplace(); });
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Keeps the memory that an array shows.
py::capsule keeperOf(std::shared_ptr<const void> memory) {
  return {new std::shared_ptr<const void>(std::move(memory)),
          [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); }};
}

// In C's order. Its strides are given, since Debian's pybind11 reads the size of an element where NumPy 2 has
// it no longer.
template <class T>
py::array_t<T> denseArray(std::size_t rows, std::vector<py::ssize_t> shapeOfRow = {},
                          const T* values = nullptr, py::handle keeper = {}) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)}, strides;
  shape.insert(shape.end(), shapeOfRow.begin(), shapeOfRow.end());
  strides.resize(shape.size(), sizeof(T));
  for (std::size_t i = shape.size() - 1; i > 0; --i) strides[i - 1] = strides[i] * shape[i];
  return {shape, strides, values, keeper};
}

py::array readOnly(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array viewOf(const SharedParticles& memory, const SharedParticles::Rows& rows) {
  constexpr auto number = static_cast<py::ssize_t>(sizeof(float));
  return readOnly(py::array_t<float>({static_cast<py::ssize_t>(memory.count), py::ssize_t{3}},
                                     {number, number * static_cast<py::ssize_t>(rows.distance)}, rows.first,
                                     keeperOf(memory.keeper)));
}

py::array copyOf(const std::vector<Particle4>& particles) {
  auto array = denseArray<float>(particles.size(), {3});
  auto values = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    values(row, 0) = particles[i].x;
    values(row, 1) = particles[i].y;
    values(row, 2) = particles[i].z;
  }
  return readOnly(array);
}

py::array positionsOf(PythonSimulation& simulation) {
  if (const auto memory = simulation.memory()) return viewOf(*memory, memory->positions);
  return copyOf(simulation.state().positions);
}
py::array velocitiesOf(PythonSimulation& simulation) {
  if (const auto memory = simulation.memory()) return viewOf(*memory, memory->velocities);
  return copyOf(simulation.state().velocities);
}

py::array inverseMassesOf(PythonSimulation& simulation) {
  if (const auto memory = simulation.memory())
    return readOnly(denseArray(memory->count, {}, memory->inverseMasses, keeperOf(memory->keeper)));
  const std::vector<Particle4> particles = simulation.state().positions;
  auto array = denseArray<float>(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) array.mutable_data()[i] = particles[i].w;
  return readOnly(array);
}

py::array facesOf(PythonSimulation& simulation) {
  const auto faces = simulation.faces();
  auto array = denseArray<std::uint32_t>(faces.size(), {3});
  std::memcpy(array.mutable_data(), faces.data(), faces.size() * sizeof(faces[0]));
  return readOnly(array);
}

// Rows of three finite numbers, one a particle.
void put(std::vector<Particle4>& particles, const Floats& rows, const char* what) {
  if (rows.ndim() != 2 || static_cast<std::size_t>(rows.shape(0)) != particles.size() || rows.shape(1) != 3)
    throw UsageError(std::string(what) + ": expected an array of shape (" + std::to_string(particles.size()) +
                     ", 3), found " + std::string(py::str(rows.attr("shape"))));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const float* row = rows.data() + 3 * i;
    if (!std::isfinite(row[0]) || !std::isfinite(row[1]) || !std::isfinite(row[2]))
      throw UsageError(std::string(what) + ": particle " + std::to_string(i) +
                       " is not finite; expected three finite numbers");
    particles[i] = {row[0], row[1], row[2], particles[i].w};
  }
}
void setPositions(PythonSimulation& simulation, const Floats& rows) {
  State state = simulation.state();
  put(state.positions, rows, "positions");
  forgetHistory(state);
  simulation.setState(state);
}
void setVelocities(PythonSimulation& simulation, const Floats& rows) {
  State state = simulation.state();
  put(state.velocities, rows, "velocities");
  forgetHistory(state);
  simulation.setState(state);
}

py::array forcesOf(PythonSimulation& simulation) {
  if (const auto forces = simulation.forces()) return copyOf(*forces);
  return copyOf(std::vector<Particle4>(simulation.particles()));
}
void setForces(PythonSimulation& simulation, const std::optional<Floats>& rows) {
  std::vector<Particle4> forces;
  if (rows) {
    forces.resize(simulation.particles());
    put(forces, *rows, "forces");
  }
  simulation.setForces(std::move(forces));
}

py::array_t<bool> pinsOf(PythonSimulation& simulation) {
  const State state = simulation.state();
  auto pins = denseArray<bool>(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) pins.mutable_data()[i] = state.positions[i].w == 0;
  return pins;
}
// Numbers are refused: they may be meant as the indices of particles.
void setPins(PythonSimulation& simulation, const py::object& value) {
  const std::size_t particles = simulation.particles();
  const py::array array = py::module_::import("numpy").attr("asarray")(value);
  const std::string type = py::str(array.attr("dtype"));
  if (type != "bool" || array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != particles)
    throw UsageError("pins: expected an array of " + std::to_string(particles) + " booleans, found " + type +
                     " of shape " + std::string(py::str(array.attr("shape"))) +
                     "; astype(bool) turns 0 and 1 into them, and indices set them in a copy of sim.pins");
  const py::array_t<bool, py::array::c_style> pins(array);
  simulation.setPins({pins.data(), particles});
}

py::dict measuresOf(PythonSimulation& simulation) {
  return py::module_::import("json").attr("loads")(simulation.measures());
}

py::dict dictOf(const Trace& trace) {
  py::dict columns;
  for (std::size_t column = 0; column < Trace::columns.size(); ++column) {
    auto values = denseArray<double>(trace.rows().size());
    for (std::size_t row = 0; row < trace.rows().size(); ++row)
      values.mutable_data()[row] = trace.rows()[row][column];
    columns[Trace::columns[column]] = values;
  }
  return columns;
}

py::array_t<std::uint8_t> render(PythonSimulation& simulation, int width, int height,
                                 const std::tuple<double, double, double>& view, int exposures) {
  const auto [right, up, zoom] = view;
  const Image image = simulation.picture({width, height, right, up, zoom, exposures});
  return denseArray(static_cast<std::size_t>(image.height), {image.width, 3}, image.rgb.data());
}

py::list colliderPositionsOf(PythonSimulation& simulation) {
  py::list places;
  for (const Vec3d& place : simulation.colliderPositions())
    places.append(py::make_tuple(place.x, place.y, place.z));
  return places;
}

// Each kind of the program's errors is a class; where Python has one of that meaning, it is one of those,
// too.
void declareErrors(py::module_& module) {
  const auto declare = [&](const char* name, const py::object& bases) {
    const std::string fullName = std::string("clothsim.") + name;
    py::object type =
        py::reinterpret_steal<py::object>(PyErr_NewException(fullName.c_str(), bases.ptr(), nullptr));
    module.attr(name) = type;
    return type.release().ptr();  // for as long as the process
  };
  const auto builtin = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
  static PyObject* const any = declare("Error", py::make_tuple(builtin(PyExc_Exception)));
  const py::object base = builtin(any);
  static PyObject* const failed =
      declare("SimulationError", py::make_tuple(base, builtin(PyExc_RuntimeError)));
  static PyObject* const usage = declare("UsageError", py::make_tuple(base, builtin(PyExc_ValueError)));
  static PyObject* const scene = declare("SceneError", py::make_tuple(base, builtin(PyExc_ValueError)));
  static PyObject* const openGl = declare("OpenGlError", py::make_tuple(base, builtin(PyExc_RuntimeError)));
  static PyObject* const files = declare("InputOutputError", py::make_tuple(base, builtin(PyExc_OSError)));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      switch (error.exitCode()) {
        case ExitCode::usage:
          return PyErr_SetString(usage, error.what());
        case ExitCode::scene:
          return PyErr_SetString(scene, error.what());
        case ExitCode::openGl:
          return PyErr_SetString(openGl, error.what());
        case ExitCode::inputOutput:
          return PyErr_SetString(files, error.what());
        case ExitCode::done:
        case ExitCode::failed:
        case ExitCode::interrupted:
          return PyErr_SetString(failed, error.what());
      }
    }
  });
}

void declareSimulation(py::module_& module) {
  const auto released = py::call_guard<ReleasedLock>();
  py::class_<PythonSimulation, Holder>(module, "Simulation", docs::simulation)
      .def(py::init([](const py::object& scene, const std::string& backend, const py::object& resolution,
                       double jitter, std::uint32_t seed, const py::kwargs& settings) {
             RemarkedScene read = readAny(scene, resolution, settings);
             const ReleasedLock others;
             return std::make_shared<PythonSimulation>(std::move(read), backend, jitter, seed);
           }),
           py::arg("scene") = "pinned2", py::kw_only(), py::arg("backend") = "auto",
           py::arg("resolution") = py::none(), py::arg("jitter") = 0.0, py::arg("seed") = 1)
      .def(
          "step", [](PythonSimulation& s, std::int64_t n) { s.step(n, poll); }, py::arg("steps") = 1,
          released, docs::step)
      .def(
          "step_frames", [](PythonSimulation& s, std::int64_t n) { s.stepFrames(n, poll); },
          py::arg("frames") = 1, released, docs::stepFrames)
      .def(
          "run",
          [](PythonSimulation& simulation, std::int64_t frames) {
            const Trace trace = [&] {
              const ReleasedLock others;
              return simulation.run(frames, poll);
            }();
            return dictOf(trace);
          },
          py::arg("frames"), docs::run)
      .def("reset", &PythonSimulation::reset, py::arg("seed") = py::none(), released, docs::reset)
      .def_property_readonly("time", &PythonSimulation::time, docs::time)
      .def_property_readonly("frame", &PythonSimulation::frame, docs::frame)
      .def_property_readonly("backend", &PythonSimulation::backend, docs::backend)
      .def_property_readonly("device", &PythonSimulation::device, docs::device)
      .def_property_readonly("remarks", &PythonSimulation::remarks, docs::remarks)
      .def_property("positions", &positionsOf, &setPositions, docs::positions)
      .def_property("velocities", &velocitiesOf, &setVelocities, docs::velocities)
      .def_property("forces", &forcesOf, &setForces, docs::forces)
      .def_property("pins", &pinsOf, &setPins, docs::pins)
      .def_property_readonly("inverse_masses", &inverseMassesOf, docs::inverseMasses)
      .def_property_readonly("faces", &facesOf, docs::faces)
      .def_property_readonly(
          "state_hash", [](PythonSimulation& s) { return hashText(stateHash(s.state())); }, docs::stateHash)
      .def_property_readonly("collider_positions", &colliderPositionsOf, docs::colliderPositions)
      .def(
          "move_collider",
          [](PythonSimulation& simulation, std::size_t collider, const std::array<double, 3>& to,
             std::optional<double> seconds) {
            simulation.moveCollider(collider, {to[0], to[1], to[2]}, seconds);
          },
          py::arg("collider"), py::arg("position"), py::arg("seconds") = py::none(), docs::moveCollider)
      .def(
          "turn_collider",
          [](PythonSimulation& simulation, std::size_t collider, const std::array<double, 3>& turn,
             std::optional<double> seconds) {
            simulation.turnCollider(collider, {turn[0], turn[1], turn[2]}, seconds);
          },
          py::arg("collider"), py::arg("turn"), py::arg("seconds") = py::none(), docs::turnCollider)
      .def(
          "set", [](PythonSimulation& s, const py::kwargs& values) { s.configure(settingsOf(values)); },
          docs::set)
      .def_property_readonly(
          "scene",
          [](PythonSimulation& simulation) {
            return py::module_::import("json").attr("loads")(formatScene(simulation.scene()));
          },
          docs::scene)
      .def("measures", &measuresOf, docs::measures)
      .def("render", &render, py::arg("width") = 1280, py::arg("height") = 720,
           py::arg("view") = std::tuple(0.0, 0.0, 1.0), py::arg("exposures") = 1, docs::render)
      .def("save", &PythonSimulation::save, py::arg("path"), docs::save)
      .def("load", &PythonSimulation::load, py::arg("path"), docs::load)
      .def(
          "get_state", [](PythonSimulation& s) { return py::bytes(formatStateFile(s.state())); },
          docs::getState)
      .def(
          "set_state",
          [](PythonSimulation& simulation, const py::bytes& bytes) {
            simulation.setState(parseStateFile(std::string(bytes), simulation.particles(), "set_state",
                                               simulation.triangles()));
          },
          py::arg("state"), docs::setState)
      .def("__repr__", &PythonSimulation::text);
}

}  // namespace
}  // namespace clothsim

PYBIND11_MODULE(_clothsim, module) {
  using namespace clothsim;
  // Scenes and shaders lie beside the module, or above it in a build folder.
  Dl_info self{};
  if (::dladdr(reinterpret_cast<const void*>(&PyInit__clothsim), &self) != 0)
    beginResourceSearchAt(std::filesystem::absolute(self.dli_fname).parent_path());
  module.attr("__version__") = CLOTHSIM_VERSION;
  // pybind11 looks NumPy up with the first array, and of two threads that come to this at once one would keep
  // what the other waits for.
  (void)py::dtype::of<float>();
  declareErrors(module);
  declareSimulation(module);
  module.def("scenes", &bundledNames, docs::scenes);
  module.def("set_threads", &setThreads, py::arg("threads"), docs::setThreads);
}
