//! Whole numbers wide enough for any two `f64`s at once: for segments that leave the guard band.

use crate::fixed::snap_real;

/// 1088 bits, two's complement, the lowest limb first: room for the difference of two `f64`s at 2⁹
/// units each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Wide([u64; Self::LIMBS]);

impl Wide {
    const LIMBS: usize = 17;
    /// Limbs of a product.
    pub(crate) const PRODUCT: usize = 2 * Self::LIMBS;

    pub(crate) fn from_i64(v: i64) -> Self {
        let mut limbs = [if v < 0 { u64::MAX } else { 0 }; Self::LIMBS];
        limbs[0] = v as u64;
        Self(limbs)
    }

    /// A finite coordinate in pixels, snapped to 1/256, in units of 1/512.
    pub(crate) fn snap(v: f64) -> Self {
        // The snapped number is exact, but would overflow near the end of the range.
        if v.abs() < 1e18 {
            let snapped = snap_real(v);
            return Self::scaled(snapped, 1);
        }
        Self::scaled(v, 9)
    }

    /// v · 2ˢʰⁱᶠᵗ for a whole v.
    fn scaled(v: f64, shift: u32) -> Self {
        if v.abs() < 4_503_599_627_370_496.0 {
            return Self::from_i64((v as i64) << shift);
        }
        // |v| ≥ 2⁵²: a mantissa of 53 bits and an exponent of at least 0.
        let bits = v.to_bits();
        let mantissa = (bits & ((1 << 52) - 1)) | 1 << 52;
        let shift = ((bits >> 52) & 0x7ff) as u32 - 1075 + shift;
        let (limb, bit) = ((shift / 64) as usize, shift % 64);
        let shifted = u128::from(mantissa) << bit;
        let mut limbs = [0; Self::LIMBS];
        limbs[limb] = shifted as u64;
        limbs[limb + 1] = (shifted >> 64) as u64;
        if v < 0.0 { Self::from_i64(0).minus(&Self(limbs)) } else { Self(limbs) }
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        let mut limbs = [0; Self::LIMBS];
        let mut borrow = false;
        for (i, out) in limbs.iter_mut().enumerate() {
            let (v, first) = self.0[i].overflowing_sub(other.0[i]);
            let (v, second) = v.overflowing_sub(u64::from(borrow));
            *out = v;
            borrow = first || second;
        }
        Self(limbs)
    }

    fn is_negative(&self) -> bool {
        self.0[Self::LIMBS - 1] >> 63 == 1
    }

    fn magnitude(&self) -> Self {
        if self.is_negative() { Self::from_i64(0).minus(self) } else { *self }
    }

    /// Whether the product is below zero, and its magnitude.
    pub(crate) fn times(&self, other: &Self) -> (bool, [u64; Self::PRODUCT]) {
        let (p, q) = (self.magnitude(), other.magnitude());
        let used = |v: &Self| v.0.iter().rposition(|&l| l != 0).map_or(0, |i| i + 1);
        let (np, nq) = (used(&p), used(&q));
        let mut out = [0u64; Self::PRODUCT];
        for i in 0..np {
            let mut carry = 0;
            for j in 0..nq {
                let sum = u128::from(p.0[i]) * u128::from(q.0[j]) + u128::from(out[i + j]) + carry;
                out[i + j] = sum as u64;
                carry = sum >> 64;
            }
            out[i + nq] = carry as u64;
        }
        let zero = np == 0 || nq == 0;
        (!zero && self.is_negative() != other.is_negative(), out)
    }
}
