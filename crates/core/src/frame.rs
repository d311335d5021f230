//! Orthonormal frames: the local space of a BSDF has the shading normal at +z.

use crate::math::Vec3;

/// Three orthonormal axes, right-handed: `t × b = n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Tangent, local +x.
    pub t: Vec3,
    /// Bitangent, local +y.
    pub b: Vec3,
    /// Normal, local +z.
    pub n: Vec3,
}

impl Frame {
    /// A frame around a unit normal, continuous except across `n.z = 0`.
    /// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
    #[inline]
    pub fn from_normal(n: Vec3) -> Self {
        let sign = 1.0f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Frame {
            t: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            b: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// A frame around a unit normal whose tangent leans towards `tangent`; falls back to [`Frame::from_normal`] where
    /// `tangent` is zero or parallel to `n`.
    #[inline]
    pub fn from_normal_tangent(n: Vec3, tangent: Vec3) -> Self {
        let t = tangent - n * n.dot(tangent);
        let len2 = t.length_squared();
        if len2.is_nan() || len2 <= 1e-12 * tangent.length_squared() {
            return Frame::from_normal(n);
        }
        let t = t / len2.sqrt();
        Frame { t, b: n.cross(t), n }
    }

    /// World to local.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.t), v.dot(self.b), v.dot(self.n))
    }

    /// Local to world.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.t * v.x + self.b * v.y + self.n * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        for i in 0..1000u32 {
            let u = [crate::hash::unit(i, 1), crate::hash::unit(i, 2)];
            let n = crate::warp::uniform_sphere(u);
            for f in [Frame::from_normal(n), Frame::from_normal_tangent(n, Vec3::new(0.3, -0.2, 0.9))] {
                assert!((f.t.cross(f.b) - f.n).length() < 1e-5, "{n} {f:?}");
                assert!((f.to_world(f.to_local(n)) - n).length() < 1e-5);
            }
        }
        assert_eq!(Frame::from_normal(Vec3::NEG_Z).n, Vec3::NEG_Z);
        assert_eq!(Frame::from_normal_tangent(Vec3::X, Vec3::X), Frame::from_normal(Vec3::X));
    }
}
