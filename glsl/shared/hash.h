// Integer hashing, the only source of randomness of the simulation; C++ and GLSL.
#ifndef TARN_SHARED_HASH
#define TARN_SHARED_HASH
#include "shared/language.h"
TARN_SHARED_BEGIN

// lowbias32 (Ellis 2018): a bijection of 32 bits.
TARN_FUNCTION TARN_UINT hash1(TARN_UINT x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

TARN_FUNCTION TARN_UINT hash2(TARN_UINT a, TARN_UINT b) { return hash1(a + 0x9e3779b9u * hash1(b + 0x85ebca6bu)); }

TARN_FUNCTION TARN_UINT hash3(TARN_UINT a, TARN_UINT b, TARN_UINT c) {
    return hash1(a + 0x9e3779b9u * hash1(b + 0x85ebca6bu * hash1(c + 0xc2b2ae35u)));
}

TARN_FUNCTION TARN_UINT hash4(TARN_UINT a, TARN_UINT b, TARN_UINT c, TARN_UINT d) {
    return hash1(a + 0x9e3779b9u * hash1(b + 0x85ebca6bu * hash1(c + 0xc2b2ae35u * hash1(d + 0x27d4eb2fu))));
}

TARN_SHARED_END
#endif
