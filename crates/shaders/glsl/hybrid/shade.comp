// What each ray of a list has met: sky or surface; asks for further rays and shadow rays in the other list.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IMAGES

layout(local_size_x = 64) in;

#include "hybrid/show.glsl"
#include "hybrid/gathered.glsl"
#include "hybrid/sums.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    uint list = push.parity;
    if (index >= push.frame.heads.rays[list].count) {
        return;
    }
    uvec4 origin = RAY(list, RAY_ORIGIN, index);
    uvec4 direction = RAY(list, RAY_DIRECTION, index);
    uvec4 beta = RAY(list, RAY_BETA, index);
    uvec4 met = RAY(list, RAY_HIT, index);
    Arrived a;
    a.pixel = beta.w;
    a.kind = ray_kind_unpack(direction.w);
    a.ray = ray_new(uintBitsToFloat(origin.xyz), uintBitsToFloat(direction.xyz), 0.0);
    a.beta = uintBitsToFloat(beta.xyz);
    a.media = medium_stack_empty();
    if (HAS_SOLID) {
        a.media = MediumStack(RAY(list, RAY_MEDIA, index), uintBitsToFloat(RAY(list, RAY_MEDIA + 1u, index)));
    }
    bool gathers = GLOBAL_ILLUMINATION && a.kind.gathers;
    uint channel = gathers ? CHANNEL_GATHERED : CHANNEL_SHARP;
    if (met.x == NONE) {
        sums_add(channel, a.pixel, gathers ? gathered_sky(a) : show_sky(a));
        return;
    }
    Hit hit = hit_of(met.x, met.y, uintBitsToFloat(met.zw), uintBitsToFloat(origin.w));
    Interaction it = interaction_new(a.ray, hit);
    a.beta *= medium_transmittance(medium_stack_current(a.media), it.t);
    Surface surface = surface_new(it, -a.ray.dir, a.media, ONE_INDEX);
    Sampler smp = frame_sampler(a.pixel);
    Spectrum light;
    if (gathers) {
        light = gathered_surface(1u - list, a, it, surface, smp);
    } else {
        light = show_surface(1u - list, a, it, surface, smp);
    }
    sums_add(channel, a.pixel, light);
}
