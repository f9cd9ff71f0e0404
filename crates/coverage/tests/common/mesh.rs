//! Random triangulations of random polygons, on the 1/256 grid.

type Point = [i64; 2];

/// A star-shaped polygon and triangles that fill it exactly, all turning the same way.
pub(crate) struct Mesh {
    pub(crate) outline: Vec<Point>,
    pub(crate) triangles: Vec<[Point; 3]>,
}

/// A small generator of numbers (xorshift64*): the cases come from proptest's seed alone.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed | 1)
    }

    pub(crate) fn below(&mut self, n: i64) -> i64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as i64 % n
    }
}

fn cross(p: Point, q: Point, r: Point) -> i64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

impl Mesh {
    /// Within about `pixels` of the origin. `grain` (a divisor of 256) is the grid of the corners:
    /// a coarse one puts many samples exactly on edges.
    pub(crate) fn random(random: &mut Random, pixels: i64, grain: i64) -> Self {
        let span = pixels * 256 / grain;
        let mut point =
            || [(random.below(span) - span / 4) * grain, (random.below(span) - span / 4) * grain];
        let center = point();
        let mut outline: Vec<Point> = (0..9).map(|_| point()).filter(|&p| p != center).collect();
        let angle = |p: &Point| ((p[1] - center[1]) as f64).atan2((p[0] - center[0]) as f64);
        outline.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
        outline.dedup_by(|p, q| cross(center, *q, *p) <= 0);
        let n = outline.len();
        let fan: Vec<_> = (0..n).map(|i| [center, outline[i], outline[(i + 1) % n]]).collect();
        if n < 3 || fan.iter().any(|t| cross(t[0], t[1], t[2]) <= 0) {
            // The centre sees less than a full turn: leave it and its last triangle out.
            let open: Vec<_> = fan.into_iter().filter(|t| cross(t[0], t[1], t[2]) > 0).collect();
            let mut outline = outline;
            // Only a single gap makes a polygon with the centre as a corner.
            if open.len() + 1 == n {
                while cross(center, outline[n - 1], outline[0]) > 0 {
                    outline.rotate_left(1);
                }
                outline.push(center);
                return Self { outline, triangles: open }.refined(random);
            }
            let triangles: Vec<_> = open.into_iter().take(1).collect();
            let outline = triangles.first().map_or(Vec::new(), |t| t.to_vec());
            return Self { outline, triangles }.refined(random);
        }
        Self { outline, triangles: fan }.refined(random)
    }

    /// Puts points into triangles, and swaps diagonals.
    fn refined(mut self, random: &mut Random) -> Self {
        for _ in 0..random.below(6) {
            if self.triangles.is_empty() {
                break;
            }
            let i = random.below(self.triangles.len() as i64) as usize;
            let [p, q, r] = self.triangles[i];
            let (u, v) = (random.below(255) + 1, random.below(255) + 1);
            let at = |k: usize| (p[k] * u + q[k] * v + r[k] * (512 - u - v)) / 512;
            let m = [at(0), at(1)];
            let parts = [[p, q, m], [q, r, m], [r, p, m]];
            if parts.iter().all(|t| cross(t[0], t[1], t[2]) > 0) {
                self.triangles[i] = parts[0];
                self.triangles.extend_from_slice(&parts[1..]);
            }
            self.swap_diagonal(random);
        }
        self
    }

    fn swap_diagonal(&mut self, random: &mut Random) {
        let i = random.below(self.triangles.len() as i64) as usize;
        let [p, q, r] = self.triangles[i];
        for j in 0..self.triangles.len() {
            for k in 0..3 {
                let t = self.triangles[j];
                if (t[k], t[(k + 1) % 3]) != (q, p) {
                    continue;
                }
                let s = t[(k + 2) % 3];
                if cross(r, p, s) > 0 && cross(s, q, r) > 0 {
                    (self.triangles[i], self.triangles[j]) = ([r, p, s], [s, q, r]);
                    return;
                }
            }
        }
    }
}
