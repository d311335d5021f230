// Integer hashes: the source of every random number, the same on both backends.
// Twin: core/src/hash.rs.
#ifndef HASH_GLSL
#define HASH_GLSL

// A 32-bit hash with good avalanche. Wellons 2018, "Prospecting for Hash Functions", `lowbias32`.
uint hash_u32(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

// Folds one more word into a hash.
uint hash_combine(uint h, uint v) {
    return hash_u32(h ^ (v * 0x9e3779b9u + 0x85ebca6bu));
}

// The top 24 bits as a float in [0, 1).
float to_unit(uint x) {
    return float(x >> 8) * (1.0 / 16777216.0);
}

#endif
