// Owen-scrambled Sobol points in four dimensions, each coordinate on its own and without tables.
// Twin: core/src/sampler/sobol.rs, which gives the same bits from tables; there are the sources of direction numbers, scrambling and
// shuffling.
//
// With S the step from one column of a generator matrix to the next and D the shift of a column to the right, the recurrence of the
// direction numbers is p(S) = D^e for a polynomial p of degree e over GF(2) (Joe and Kuo 2008). Squared again and again it is
// p(S^w) = D^(e w) for every power of two w, since squares of sums are sums of squares there. So the bits of an index, as a polynomial in S, are
// divided by p(S^w) for falling w: the quotient goes on e w places further right, the remainder stays where it is. Each division works on
// all parts of the word at once; what is left in the end are combinations of the first e columns.
#ifndef SOBOL_GLSL
#define SOBOL_GLSL

#include "hash.glsl"

// Divides by S^w + 1. `low` masks the lower halves of the blocks of 2 w bits.
uint sobol_step1(uint x, uint w, uint low) {
    return x ^ ((x >> w) & low);
}

// Divides by S^2w + S^w + 1. `low` masks the lower halves of the blocks of 4 w bits, `lowest` their first quarters.
uint sobol_step2(uint x, uint w, uint low, uint lowest) {
    uint high = (x >> (2u * w)) & low;
    uint q = high ^ ((high >> w) & lowest);
    return (x & low) ^ q ^ ((q << w) & low) ^ (q << (2u * w));
}

// Divides by S^3w + S^w + 1. `low` masks the lower halves of the blocks of 6 w bits, `lowest` their first sixths.
uint sobol_step3(uint x, uint w, uint low, uint lowest) {
    uint high = (x >> (3u * w)) & low;
    uint q = high ^ ((high >> (2u * w)) & lowest);
    return (x & low) ^ q ^ ((q << w) & low) ^ (q << (3u * w));
}

// Coordinate `d` (0 to 3, known when compiled) of point `index` of the plain Sobol sequence, its bits reversed.
uint sobol_reversed(uint index, uint d) {
    uint x = index;
    if (d == 1u) {
        x = sobol_step1(x, 16u, 0x0000ffffu);
        x = sobol_step1(x, 8u, 0x00ff00ffu);
        x = sobol_step1(x, 4u, 0x0f0f0f0fu);
        x = sobol_step1(x, 2u, 0x33333333u);
        x = sobol_step1(x, 1u, 0x55555555u);
    } else if (d == 2u) {
        x = sobol_step2(x, 8u, 0x0000ffffu, 0x000000ffu);
        x = sobol_step2(x, 4u, 0x00ff00ffu, 0x000f000fu);
        x = sobol_step2(x, 2u, 0x0f0f0f0fu, 0x03030303u);
        x = sobol_step2(x, 1u, 0x33333333u, 0x11111111u);
        // The first columns begin with 1 and 11.
        x ^= (x >> 1) & 0x55555555u;
    } else if (d == 3u) {
        x = sobol_step3(x, 8u, 0x00ffffffu, 0x000000ffu);
        x = sobol_step3(x, 4u, 0xff000fffu, 0x0f00000fu);
        x = sobol_step3(x, 2u, 0x3f03f03fu, 0x03003003u);
        x = sobol_step3(x, 1u, 0xc71c71c7u, 0x41041041u);
        // The first columns begin with 1, 11 and 001.
        x ^= (x >> 1) & 0x49249249u;
    }
    return x;
}

// A hash in which each bit is moved only by those below it: an Owen scramble of the bit-reversed value.
uint laine_karras(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// The place of point `index` in an order shuffled by `key`.
uint sobol_shuffled(uint index, uint key) {
    return bitfieldReverse(laine_karras(bitfieldReverse(index), key));
}

// A coordinate of such a point, its bits reversed, scrambled by `key`: a binary fraction.
uint sobol_scrambled(uint reversed, uint key, uint d) {
    return bitfieldReverse(laine_karras(reversed, hash_combine(key ^ 0xa511e9b3u, d)));
}

#endif
