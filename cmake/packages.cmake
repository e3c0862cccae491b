# What clothsim stands on, from the system's packages (tools/packages.txt lists Debian's names). A package that the system
# lacks is fetched by FetchContent where that is possible; nothing is vendored.
include(FetchContent)

find_package(Threads REQUIRED)

FetchContent_Declare(nlohmann_json URL https://github.com/nlohmann/json/releases/download/v3.11.2/json.tar.xz
                     FIND_PACKAGE_ARGS 3.10)
FetchContent_MakeAvailable(nlohmann_json)

# Scene files are read with RapidJSON, which tells where a value or a mistake is; results are written with nlohmann::json.
# SOURCE_SUBDIR has no CMakeLists.txt: of what is fetched only the headers are used.
FetchContent_Declare(RapidJSON URL https://github.com/Tencent/rapidjson/archive/refs/tags/v1.1.0.tar.gz SOURCE_SUBDIR include
                     FIND_PACKAGE_ARGS 1.1)
FetchContent_MakeAvailable(RapidJSON)
add_library(clothsim_rapidjson INTERFACE)
if(RapidJSON_FOUND)
  target_include_directories(clothsim_rapidjson SYSTEM INTERFACE ${RAPIDJSON_INCLUDE_DIRS})
else()
  target_include_directories(clothsim_rapidjson SYSTEM INTERFACE ${rapidjson_SOURCE_DIR}/include)
endif()

FetchContent_Declare(tinyobjloader GIT_REPOSITORY https://github.com/tinyobjloader/tinyobjloader GIT_TAG v2.0.0rc10
                     FIND_PACKAGE_ARGS)
FetchContent_MakeAvailable(tinyobjloader)
if(NOT TARGET tinyobjloader::tinyobjloader)
  add_library(tinyobjloader::tinyobjloader ALIAS tinyobjloader)
endif()

# stb has no CMake package: Debian installs the headers in include/stb and the implementations in libstb.
find_path(STB_INCLUDE_DIR stb/stb_image_write.h REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)
add_library(clothsim_stb INTERFACE)
target_include_directories(clothsim_stb SYSTEM INTERFACE ${STB_INCLUDE_DIR})
target_link_libraries(clothsim_stb INTERFACE ${STB_LIBRARY})

# Debian's CMake package of libzip asks for command line tools that are packages of their own.
find_path(ZIP_INCLUDE_DIR zip.h REQUIRED)
find_library(ZIP_LIBRARY zip REQUIRED)
add_library(clothsim_zip INTERFACE)
target_include_directories(clothsim_zip SYSTEM INTERFACE ${ZIP_INCLUDE_DIR})
target_link_libraries(clothsim_zip INTERFACE ${ZIP_LIBRARY})

# Debian's CMake package of Open Asset Import Library asks for what it was built with.
find_path(ASSIMP_INCLUDE_DIR assimp/Exporter.hpp REQUIRED)
find_library(ASSIMP_LIBRARY assimp REQUIRED)
add_library(clothsim_assimp INTERFACE)
target_include_directories(clothsim_assimp SYSTEM INTERFACE ${ASSIMP_INCLUDE_DIR})
target_link_libraries(clothsim_assimp INTERFACE ${ASSIMP_LIBRARY})

# Counts crossings (src/measure/crossings.cpp). Not needed to simulate: without it --check-crossings says what to install.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL 5.0 QUIET)

if(CLOTHSIM_PROGRAM)
  find_package(OpenGL REQUIRED COMPONENTS EGL)
  FetchContent_Declare(glfw3 URL https://github.com/glfw/glfw/releases/download/3.3.8/glfw-3.3.8.zip FIND_PACKAGE_ARGS 3.3)
  FetchContent_Declare(glm GIT_REPOSITORY https://github.com/g-truc/glm GIT_TAG 0.9.9.8 FIND_PACKAGE_ARGS)
  FetchContent_Declare(CLI11 GIT_REPOSITORY https://github.com/CLIUtils/CLI11 GIT_TAG v2.1.2 FIND_PACKAGE_ARGS 2.1)
  FetchContent_MakeAvailable(glfw3 glm CLI11)

  # Debian's Dear ImGui: the GLFW and OpenGL 3 backends are inside the library, which needs stb.
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(IMGUI REQUIRED imgui)
  add_library(clothsim_imgui INTERFACE)
  target_include_directories(clothsim_imgui SYSTEM INTERFACE ${IMGUI_INCLUDE_DIRS} ${IMGUI_INCLUDE_DIRS}/backends)
  target_link_libraries(clothsim_imgui INTERFACE ${IMGUI_LIBRARIES} clothsim_stb)

  # The OpenGL loader, generated from the package's own copy of the specification.
  find_program(GLAD_PROGRAM glad REQUIRED)
  set(GLAD_FOLDER ${PROJECT_BINARY_DIR}/glad)
  if(NOT EXISTS ${GLAD_FOLDER}/src/gl.c)
    execute_process(COMMAND ${GLAD_PROGRAM} --api gl:core=4.5 --extensions "" --reproducible --quiet --out-path ${GLAD_FOLDER} c
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()
  add_library(glad_gl45 STATIC ${GLAD_FOLDER}/src/gl.c)
  target_include_directories(glad_gl45 SYSTEM PUBLIC ${GLAD_FOLDER}/include)
endif()
