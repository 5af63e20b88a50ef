//! Which triangle does a ray hit first?
//!
//! The tree is built and walked by `obvhs`; the triangle test is here, because shared edges must not leak: a ray that
//! meets the edge between two triangles hits at least one of them. The test takes the signs of three volumes, one for
//! each edge, and a shared edge gives both neighbours the same volume with exactly the opposite sign (the test of
//! Embree's robust mode, after Plücker coordinates).

use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::ray::{Ray, RayHit};

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
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|&[a, b, c]| {
                let (low, high) = (a.min(b).min(c), a.max(b).max(c));
                Aabb::new(Vec3A::from(low) - padding, Vec3A::from(high) + padding)
            })
            .collect();
        // These are the steps of obvhs's "medium" build, without the checks that it makes in debug builds.
        let indices = (0..triangles.len() as u32).collect();
        let mut tree =
            PlocBuilder::new().build(PlocSearchDistance::Medium, &boxes, indices, SortPrecision::U64, 3);
        let mut optimizer = ReinsertionOptimizer::default();
        optimizer.run(&mut tree, 0.05, None);
        collapse(&mut tree, 8, 3.0);
        optimizer.run(&mut tree, 0.1, None);
        tree.max_depth = depth(&tree) + 1;

        let original = std::mem::take(&mut tree.primitive_indices);
        let corners =
            original.iter().map(|&at| Corners(triangles[at as usize].map(Vec3A::from))).collect();
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

    /// Calls `f` with each triangle that the ray meets before `t_max`, in no particular order.
    #[inline]
    pub(crate) fn for_each(&self, origin: Vec3A, direction: Vec3A, t_max: f32, mut f: impl FnMut(u32)) {
        let ray = Ray::new(origin, direction, 0.0, t_max);
        self.tree.ray_traverse_anyhit(ray, |ray, at| {
            if self.corners[at].intersect(ray).is_some_and(|(t, _)| t < ray.tmax) {
                f(self.original[at]);
            }
        });
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
        let inside = w0.min(w1).min(w2) >= 0.0 || w0.max(w1).max(w2) <= 0.0;
        if !inside {
            return None;
        }
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
