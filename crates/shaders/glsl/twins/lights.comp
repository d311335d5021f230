// Twin test of the lights without tables, light/{point,spot,directional,sun,triangle}.glsl: testkit/tests/twins/lights.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "light/directional.glsl"
#include "light/point.glsl"
#include "light/spot.glsl"
#include "light/sun.glsl"
#include "light/triangle.glsl"

struct Input {
    vec3 position;
    vec3 intensity;
    Cone cone;
    SunDisc sun;
    TriangleLight triangle;
    vec3 p;
    vec3 wi;
    vec2 u;
};
struct Output {
    uint found_point;
    DeltaSample point;
    uint found_spot;
    DeltaSample spot;
    DeltaSample directional;
    vec3 on_sun;
    float sun_pdf;
    uint found_triangle;
    TriangleSample triangle;
};

#include "twins/kernel.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Output o;
    o.found_point = uint(point_sample(it.position, it.intensity, it.p, o.point));
    o.found_spot = uint(spot_sample(it.position, it.intensity, it.cone, it.p, o.spot));
    o.directional = directional_sample(it.cone.axis, it.intensity);
    o.on_sun = sun_sample(it.sun, it.u);
    o.sun_pdf = sun_pdf(it.sun, it.wi);
    o.found_triangle = uint(triangle_light_sample(it.triangle, it.p, it.u, o.triangle));
    push.outputs.at[i] = o;
}
