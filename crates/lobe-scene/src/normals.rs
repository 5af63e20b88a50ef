//! Normals for corners that have none.
//!
//! The normal of a corner is the mean of the face normals around its point, each weighted by the angle that
//! its face has there (Thürmer & Wüthrich, *Computing vertex normals from polygonal facets*, 1998): then it
//! does not depend on how the faces were cut into triangles. *Which* faces belong to the mean is the
//! question of [`Smoothing`].

use crate::mesh::{Mesh, area_vector};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::collections::HashMap;

/// In [`Triangle::normals`](crate::Triangle::normals) while a mesh is being made: to be computed.
pub(crate) const MISSING: u32 = u32::MAX;

/// Which faces share a normal where they meet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Smoothing {
    /// None: every face keeps its own.
    Flat,
    /// Faces of the same smoothing group; group 0 is flat. The statement `s` of OBJ.
    Groups,
    /// Faces that meet in an edge bent by at most this angle, and so on around the point.
    /// An edge with three faces or more is sharp.
    Crease {
        /// The angle between the normals of two faces, 0 … 180.
        degrees: f32,
    },
}

/// Computes the normals of all corners marked [`MISSING`]. `groups` holds the smoothing group of each triangle
/// (only [`Smoothing::Groups`] looks at it; missing ones are 0). All triangles must have an area.
pub(crate) fn fill(mesh: &mut Mesh, groups: &[u32], smoothing: Smoothing) {
    if mesh.triangles.iter().all(|triangle| !triangle.normals.contains(&MISSING)) {
        return;
    }
    let faces: Vec<DVec3> =
        mesh.triangles.iter().map(|triangle| area_vector(mesh.corners(triangle)).normalize_or_zero()).collect();
    let classes = match smoothing {
        Smoothing::Flat => Classes::flat(mesh),
        Smoothing::Groups => Classes::of_groups(mesh, groups),
        Smoothing::Crease { degrees } => Classes::of_creases(mesh, &faces, degrees),
    };

    let mut sums = vec![DVec3::ZERO; classes.count];
    for (at, triangle) in mesh.triangles.iter().enumerate() {
        let corners = mesh.corners(triangle);
        for corner in 0..3 {
            sums[classes.of_corner[3 * at + corner] as usize] += faces[at] * angle_at(corners, corner);
        }
    }

    let mut index_of_class = vec![MISSING; classes.count];
    for (at, triangle) in mesh.triangles.iter_mut().enumerate() {
        for corner in 0..3 {
            if triangle.normals[corner] != MISSING {
                continue;
            }
            let class = classes.of_corner[3 * at + corner] as usize;
            // Opposite faces may cancel; then the face's own normal is the honest one.
            let usable = sums[class].length() > 1e-6;
            if usable && index_of_class[class] != MISSING {
                triangle.normals[corner] = index_of_class[class];
                continue;
            }
            let normal = if usable { sums[class].normalize() } else { faces[at] };
            let index = mesh.normals.len() as u32;
            mesh.normals.push(normal.as_vec3());
            triangle.normals[corner] = index;
            if usable {
                index_of_class[class] = index;
            }
        }
    }
}

/// The angle of a triangle at one of its corners, in radians.
fn angle_at(corners: [Vec3; 3], corner: usize) -> f64 {
    let here = corners[corner].as_dvec3();
    let a = corners[(corner + 1) % 3].as_dvec3() - here;
    let b = corners[(corner + 2) % 3].as_dvec3() - here;
    // The arc tangent keeps its accuracy for needle-like triangles, where the arc cosine loses it.
    a.cross(b).length().atan2(a.dot(b))
}

/// Corners (three for each triangle, in order) put into classes that share a normal.
struct Classes {
    of_corner: Vec<u32>,
    count: usize,
}

impl Classes {
    fn flat(mesh: &Mesh) -> Self {
        let of_corner = (0..mesh.triangles.len() as u32).flat_map(|at| [at; 3]).collect();
        Self { of_corner, count: mesh.triangles.len() }
    }

    fn of_groups(mesh: &Mesh, groups: &[u32]) -> Self {
        let points = weld(&mesh.positions);
        let mut known: HashMap<(u32, u32), u32> = HashMap::new();
        let mut count = 0;
        let mut of_corner = Vec::with_capacity(3 * mesh.triangles.len());
        for (at, triangle) in mesh.triangles.iter().enumerate() {
            let group = groups.get(at).copied().unwrap_or(0);
            if group == 0 {
                of_corner.extend([count; 3]);
                count += 1;
                continue;
            }
            for corner in triangle.positions {
                let class = *known.entry((points[corner as usize], group)).or_insert(count);
                count += u32::from(class == count);
                of_corner.push(class);
            }
        }
        Self { of_corner, count: count as usize }
    }

    fn of_creases(mesh: &Mesh, faces: &[DVec3], degrees: f32) -> Self {
        let points = weld(&mesh.positions);
        // The two ends of each side, and its corners there. Sorted and not hashed, which takes three times as long.
        let sides = (0..3 * mesh.triangles.len()).into_par_iter().map(|tail| {
            let head = tail - tail % 3 + (tail + 1) % 3;
            let [p, q] = [tail, head].map(|corner| points[mesh.triangles[corner / 3].positions[corner % 3] as usize]);
            if p <= q { ([p, q], [tail as u32, head as u32]) } else { ([q, p], [head as u32, tail as u32]) }
        });
        let mut sides: Vec<_> = sides.collect();
        sides.par_sort_unstable();
        let smoothest = f64::from(degrees).to_radians();
        let mut sets = Sets::new(3 * mesh.triangles.len());
        // An edge of one face is a rim, and one of three or more is sharp.
        for edge in sides.chunk_by(|(a, _), (b, _)| a == b) {
            if let [(_, first), (_, second)] = edge {
                let [a, b] = [first[0], second[0]].map(|corner| faces[corner as usize / 3]);
                // A hair of tolerance, so that an angle of exactly 30° counts as 30° after rounding.
                if a.cross(b).length().atan2(a.dot(b)) <= smoothest + 1e-6 {
                    sets.unite(first[0], second[0]);
                    sets.unite(first[1], second[1]);
                }
            }
        }
        sets.number()
    }
}

/// Sets that can be united (Tarjan's union-find). The smallest member represents its set, so that the result does not
/// depend on the order of the unions.
struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    fn find(&mut self, mut at: u32) -> u32 {
        while self.parent[at as usize] != at {
            let above = self.parent[self.parent[at as usize] as usize];
            self.parent[at as usize] = above;
            at = above;
        }
        at
    }

    fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    fn number(mut self) -> Classes {
        let mut count = 0;
        let mut of_corner = vec![0; self.parent.len()];
        for at in 0..self.parent.len() {
            let root = self.find(at as u32) as usize;
            // The root is the smallest member: its number is known before the others ask.
            if root == at {
                of_corner[at] = count;
                count += 1;
            } else {
                of_corner[at] = of_corner[root];
            }
        }
        Classes { of_corner, count: count as usize }
    }
}

/// For each position the first one that is equal to it: files without shared points have a seam at every edge.
fn weld(positions: &[Vec3]) -> Vec<u32> {
    // Adding zero makes −0 equal to 0.
    let bits = |position: &Vec3| (*position + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut sorted: Vec<_> = positions.par_iter().zip(0..positions.len() as u32).map(|(p, at)| (bits(p), at)).collect();
    sorted.par_sort_unstable();
    let mut first = vec![0; positions.len()];
    for same in sorted.chunk_by(|(a, _), (b, _)| a == b) {
        for (_, at) in same {
            first[*at as usize] = same[0].1;
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;

    /// Two unit squares that meet in the y axis, the second one lifted by `angle` degrees.
    fn folded(angle: f32) -> Mesh {
        let (s, c) = angle.to_radians().sin_cos();
        let positions = vec![
            Vec3::new(-1.0, 0.0, 0.0),
            Vec3::new(0.0, 0.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(-1.0, 1.0, 0.0),
            Vec3::new(c, 0.0, s),
            Vec3::new(c, 1.0, s),
        ];
        let faces = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]];
        let triangles = faces
            .map(|positions| Triangle { positions, normals: [MISSING; 3], vertices: [0; 3], material: 0 })
            .to_vec();
        Mesh { positions, triangles, ..Mesh::default() }
    }

    fn normal(mesh: &Mesh, triangle: usize, corner: usize) -> Vec3 {
        mesh.normals[mesh.triangles[triangle].normals[corner] as usize]
    }

    #[test]
    fn an_edge_is_smooth_up_to_the_crease_angle() {
        for (angle, smooth) in [(10.0, true), (30.0, true), (31.0, false), (90.0, false)] {
            let mut mesh = folded(angle);
            fill(&mut mesh, &[], Smoothing::Crease { degrees: 30.0 });
            let (left, right) = (normal(&mesh, 0, 1), normal(&mesh, 2, 0));
            assert_eq!(left == right, smooth, "{angle}");
            if smooth {
                // Half way between the two squares, whatever the diagonals are.
                let (s, c) = (angle / 2.0).to_radians().sin_cos();
                assert!((left - Vec3::new(-s, 0.0, c)).length() < 1e-6, "{left}");
            } else {
                assert_eq!(left, Vec3::Z);
            }
            // Away from the fold each square is flat.
            assert_eq!(normal(&mesh, 0, 0), Vec3::Z);
        }
    }

    #[test]
    fn groups_decide_whatever_the_angle() {
        let mut mesh = folded(80.0);
        fill(&mut mesh, &[1, 1, 1, 1], Smoothing::Groups);
        assert_eq!(normal(&mesh, 0, 1), normal(&mesh, 2, 0));
        let mut mesh = folded(5.0);
        fill(&mut mesh, &[1, 1, 2, 2], Smoothing::Groups);
        assert_eq!(normal(&mesh, 0, 1), Vec3::Z);
        assert_ne!(normal(&mesh, 2, 0), Vec3::Z);
        let mut mesh = folded(5.0);
        fill(&mut mesh, &[0, 0, 0, 0], Smoothing::Groups);
        assert_eq!(normal(&mesh, 0, 1), Vec3::Z);
    }

    #[test]
    fn unshared_points_are_welded() {
        let mut mesh = folded(10.0);
        mesh.positions = mesh.triangles.iter().flat_map(|triangle| mesh.corners(triangle)).collect();
        for (at, triangle) in mesh.triangles.iter_mut().enumerate() {
            triangle.positions = [0, 1, 2].map(|corner| (3 * at + corner) as u32);
        }
        fill(&mut mesh, &[], Smoothing::Crease { degrees: 30.0 });
        assert_eq!(normal(&mesh, 0, 1), normal(&mesh, 2, 0));
        assert_ne!(normal(&mesh, 0, 1), Vec3::Z);
    }

    #[test]
    fn faces_back_to_back_keep_their_own() {
        let mut mesh = folded(0.0);
        mesh.triangles.truncate(1);
        let mut back = mesh.triangles[0];
        back.positions.swap(1, 2);
        mesh.triangles.push(back);
        fill(&mut mesh, &[1, 1], Smoothing::Groups);
        assert_eq!(normal(&mesh, 0, 0), Vec3::Z);
        assert_eq!(normal(&mesh, 1, 0), -Vec3::Z);
    }
}
