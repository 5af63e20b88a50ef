//! Which triangle does a ray hit first?
//!
//! The tree is built and walked by `obvhs`: its binary tree, which for 109,000 triangles at 1280×720 took half the
//! time of its eight-way compressed one (0.5 against 1.0 s, two cores, SSE2), and has no limit of depth. The stack is
//! sized by the depth of the finished tree. The triangle test is here, because shared edges must not leak: a ray that
//! meets the edge between two triangles hits at least one of them. The test takes the signs of three volumes, one for
//! each edge, and a shared edge gives both neighbours the same volume with exactly the opposite sign (the test of
//! Embree's robust mode, after Plücker coordinates). Where a sign is in doubt it is computed again in `f64`.

use crate::mesh::first_in_place;
use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::ray::{Ray, RayHit};
use rayon::prelude::*;

/// A triangle as the ray test wants it.
#[derive(Debug, Clone, Copy)]
struct Corners([Vec3A; 3]);

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hit {
    /// The triangle, in the order in which they were given.
    pub(crate) triangle: u32,
    /// Distance along the ray, in lengths of its direction.
    pub(crate) t: f32,
    /// Barycentric weights of the corners; their sum is 1 up to rounding.
    pub(crate) weights: [f32; 3],
}

/// A tree over triangles.
pub(crate) struct Bvh {
    tree: Bvh2,
    /// In the order of the leaves.
    corners: Vec<Corners>,
    /// For each of those its place in the caller's order.
    original: Vec<u32>,
}

impl Bvh {
    /// Builds the tree. All coordinates are finite and at most [`MAX_COORDINATE`](crate::MAX_COORDINATE).
    pub(crate) fn new(triangles: &[[Vec3; 3]]) -> Self {
        // The box test rounds by a few units in the last place of the coordinates; boxes that much larger do not
        // lose a triangle to it.
        let largest = triangles.iter().flatten().fold(0.0_f32, |largest, point| largest.max(point.abs().max_element()));
        let padding = Vec3A::splat(8.0 * f32::EPSILON * largest);
        // The builder pairs the boxes that fit best. Among equal boxes it finds but one pair in each pass over all of
        // them, and its time becomes quadratic. Of triangles in the same place no ray needs more than the first.
        let is_first = first_in_place(triangles.par_iter().copied());
        let distinct: Vec<u32> = (0..).zip(is_first).filter_map(|(at, first)| first.then_some(at)).collect();
        let boxes: Vec<Aabb> = distinct
            .iter()
            .map(|&at| {
                let [a, b, c] = triangles[at as usize];
                let (low, high) = (a.min(b).min(c), a.max(b).max(c));
                Aabb::new(Vec3A::from(low) - padding, Vec3A::from(high) + padding)
            })
            .collect();
        // These are the steps of obvhs's "medium" build, without the checks that it makes in debug builds.
        let indices = (0..boxes.len() as u32).collect();
        let mut tree = PlocBuilder::new().build(PlocSearchDistance::Medium, &boxes, indices, SortPrecision::U64, 3);
        let mut optimizer = ReinsertionOptimizer::default();
        optimizer.run(&mut tree, 0.05, None);
        collapse(&mut tree, 8, 3.0);
        optimizer.run(&mut tree, 0.1, None);
        tree.max_depth = depth(&tree) + 1;

        let order = std::mem::take(&mut tree.primitive_indices);
        let original: Vec<u32> = order.into_iter().map(|at| distinct[at as usize]).collect();
        let corners = original.iter().map(|&at| Corners(triangles[at as usize].map(Vec3A::from))).collect();
        Self { tree, corners, original }
    }

    /// The nearest triangle that the ray meets before `t_max`.
    #[inline]
    pub(crate) fn nearest(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<Hit> {
        let ray = Ray::new(origin, direction, 0.0, t_max);
        let mut nearest = None;
        self.tree.ray_traverse(ray, &mut RayHit::none(), |ray, at| match self.corners[at].intersect(ray) {
            Some((t, weights)) if t < ray.tmax => {
                nearest = Some(Hit { triangle: at as u32, t, weights });
                t
            }
            _ => f32::INFINITY,
        });
        nearest.map(|hit| Hit { triangle: self.original[hit.triangle as usize], ..hit })
    }

    /// Whether the ray meets no triangle at all before `t_max`.
    #[inline]
    pub(crate) fn is_free(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> bool {
        let ray = Ray::new(origin, direction, 0.0, t_max);
        self.tree.ray_traverse_miss(ray, |ray, at| self.corners[at].intersect(ray).map_or(f32::INFINITY, |(t, _)| t))
    }
}

impl Corners {
    /// Distance and weights, if the ray meets the triangle at a distance of at least 0. From both sides.
    #[inline(always)]
    fn intersect(&self, ray: &Ray) -> Option<(f32, [f32; 3])> {
        let [v0, v1, v2] = self.0.map(|corner| corner - ray.origin);
        let (e0, e1, e2) = (v2 - v0, v0 - v1, v1 - v2);
        // Six times the signed volumes between the ray and each edge. The weight of a corner is the volume of the
        // edge opposite to it.
        let w1 = e0.cross(v2 + v0).dot(ray.direction);
        let w2 = e1.cross(v0 + v1).dot(ray.direction);
        let w0 = e2.cross(v1 + v2).dot(ray.direction);
        let mut weights = [w0, w1, w2];
        if !same_sign(weights) {
            // A volume below its rounding error has no sign to speak of, and around a point that several triangles
            // share all of them could say no. Then the signs are taken again with twice the digits.
            let edge = e0.abs().max(e1.abs()).max(e2.abs()).max_element();
            let reach = v0.abs().max(v1.abs()).max(v2.abs()).max_element();
            let unsure = 32.0 * f32::EPSILON * edge * reach;
            if w0.min(w1).min(w2) < -unsure && w0.max(w1).max(w2) > unsure {
                return None;
            }
            weights = volumes_in_double([v0, v1, v2], ray.direction);
            if !same_sign(weights) {
                return None;
            }
        }
        let [w0, w1, w2] = weights;
        let normal = e0.cross(e1);
        let sum = w0 + w1 + w2;
        let t = v0.dot(normal) / normal.dot(ray.direction);
        // A triangle seen exactly from its edge has no area: t and the weights are not numbers.
        if !(t >= 0.0 && t.is_finite() && sum != 0.0) {
            return None;
        }
        Some((t, [w0 / sum, w1 / sum, w2 / sum]))
    }
}

#[inline(always)]
fn same_sign([a, b, c]: [f32; 3]) -> bool {
    a.min(b).min(c) >= 0.0 || a.max(b).max(c) <= 0.0
}

/// The volumes of [`Corners::intersect`], in `f64`.
#[cold]
fn volumes_in_double(corners: [Vec3A; 3], direction: Vec3A) -> [f32; 3] {
    let [v0, v1, v2] = corners.map(|corner| corner.as_dvec3());
    let direction = direction.as_dvec3();
    let volume = |a: glam::DVec3, b: glam::DVec3| (b - a).cross(a + b).dot(direction) as f32;
    [volume(v2, v1), volume(v0, v2), volume(v1, v0)]
}

/// The most nodes that can wait on the stack: the depth of the tree.
fn depth(tree: &Bvh2) -> usize {
    let mut deepest = 0;
    let mut waiting = vec![(0_u32, 1_usize)];
    while let Some((at, depth)) = waiting.pop() {
        deepest = deepest.max(depth);
        if let Some(node) = tree.nodes.get(at as usize).filter(|node| !node.is_leaf()) {
            waiting.push((node.first_index, depth + 1));
            waiting.push((node.first_index + 1, depth + 1));
        }
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::sphere;
    use proptest::prelude::*;

    fn triangles(around: u32) -> Vec<[Vec3; 3]> {
        let (points, faces) = sphere(Vec3::new(3.0, -2.0, 1.0), 1.0, around);
        faces.iter().map(|face| face.map(|at| points[at as usize])).collect()
    }

    #[test]
    fn the_tree_is_the_same_for_any_number_of_threads() {
        let triangles = triangles(120);
        let build = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let bvh = pool.install(|| Bvh::new(&triangles));
            let nodes: Vec<_> = bvh
                .tree
                .nodes
                .iter()
                .map(|node| (node.first_index, node.prim_count, node.aabb.min, node.aabb.max))
                .collect();
            (bvh.original, nodes)
        };
        let one = build(1);
        assert!(one == build(2) && one == build(7));
    }

    /// From inside a closed surface every ray hits, also those aimed exactly at points and edges.
    #[test]
    fn a_closed_surface_has_no_holes() {
        let triangles = triangles(40);
        let bvh = Bvh::new(&triangles);
        let inside = Vec3::new(3.1, -2.2, 1.05);
        for [a, b, c] in &triangles {
            for target in [*a, (*a + *b) / 2.0, *a * 0.3 + *b * 0.7, *b * 0.99 + *c * 0.01, (*a + *b + *c) / 3.0] {
                let direction = (target - inside).normalize();
                assert!(bvh.nearest(inside.into(), direction.into(), f32::INFINITY).is_some(), "{target}");
                assert!(!bvh.is_free(inside.into(), direction.into(), f32::INFINITY), "{target}");
            }
        }
    }

    proptest! {
        /// The tree finds what trying all triangles finds.
        #[test]
        fn nearest_is_the_nearest(
            points in prop::collection::vec(prop::array::uniform3(-10.0_f32..10.0), 3..60),
            origin in prop::array::uniform3(-12.0_f32..12.0),
            direction in prop::array::uniform3(-1.0_f32..1.0),
        ) {
            let triangles: Vec<[Vec3; 3]> =
                points.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]].map(Vec3::from)).collect();
            let direction = Vec3A::from(direction).normalize_or(Vec3A::X);
            let origin = Vec3A::from(origin);
            let bvh = Bvh::new(&triangles);
            let found = bvh.nearest(origin, direction, f32::INFINITY);
            let ray = Ray::new(origin, direction, 0.0, f32::INFINITY);
            let all = triangles.iter().filter_map(|corners| Corners(corners.map(Vec3A::from)).intersect(&ray));
            let expected = all.map(|(t, _)| t).fold(f32::INFINITY, f32::min);
            prop_assert_eq!(found.map_or(f32::INFINITY, |hit| hit.t), expected);
            prop_assert_eq!(bvh.is_free(origin, direction, f32::INFINITY), found.is_none());
        }
    }
}
