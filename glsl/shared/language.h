// Lets the files of this folder compile as C++ and as GLSL. X-macro lists are the same in both; nothing here
// may use ## or # (absent from GLSL).
#ifndef TARN_SHARED_LANGUAGE
#define TARN_SHARED_LANGUAGE
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define TARN_SHARED_BEGIN namespace tarn {
#define TARN_SHARED_END }
#define TARN_FUNCTION constexpr
#define TARN_CONSTANT constexpr
#define TARN_UINT std::uint32_t
#else
#define TARN_SHARED_BEGIN
#define TARN_SHARED_END
#define TARN_FUNCTION
#define TARN_CONSTANT const
#define TARN_UINT uint
#endif
#endif
