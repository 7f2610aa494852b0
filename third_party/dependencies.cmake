# One recipe per dependency: every one is a system package (see `play` for the list), none is downloaded.
find_package(PkgConfig REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(fmt REQUIRED)
find_package(glfw3 3.3 REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenEXR REQUIRED CONFIG)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
find_path(CLI11_INCLUDE CLI/CLI.hpp REQUIRED)
find_path(STB_INCLUDE stb/stb_image_write.h REQUIRED)
find_package(Threads REQUIRED)
# Optional: what `tarn bench` compares rays with (Debian: libembree-dev).
find_path(EMBREE_INCLUDE embree3/rtcore.h)
find_library(EMBREE_LIBRARY embree3)

# glad: the loader is generated into the build tree from the gl.xml that the python3-glad package ships.
find_program(TARN_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(GLAD_DIR ${CMAKE_BINARY_DIR}/third_party/glad)
add_custom_command(
    OUTPUT ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h
    COMMAND ${TARN_PYTHON} -m glad --reproducible --quiet --api gl:core=4.5 --extensions "" --out-path ${GLAD_DIR} c
    COMMENT "Generating the OpenGL 4.5 core loader with glad"
    VERBATIM)
add_library(glad STATIC ${GLAD_DIR}/src/gl.c)
target_include_directories(glad SYSTEM PUBLIC ${GLAD_DIR}/include)

add_library(tarn_imgui INTERFACE)
target_link_libraries(tarn_imgui INTERFACE PkgConfig::IMGUI glfw)
target_include_directories(tarn_imgui SYSTEM INTERFACE ${IMGUI_INCLUDE_DIRS})

add_library(tarn_cli11 INTERFACE)
target_include_directories(tarn_cli11 SYSTEM INTERFACE ${CLI11_INCLUDE})

add_library(tarn_stb INTERFACE)
target_include_directories(tarn_stb SYSTEM INTERFACE ${STB_INCLUDE})
