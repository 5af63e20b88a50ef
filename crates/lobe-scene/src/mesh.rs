//! Triangles with normals and materials.

use crate::Error;
use glam::{DVec3, Vec2, Vec3, Vec4};
use rayon::prelude::*;

/// The largest coordinate that a mesh may have, in units of the scene.
///
/// Beyond it products of four lengths would leave the range of `f32` in the ray caster.
pub const MAX_COORDINATE: f32 = 1e9;

/// One triangle: indices into its [`Mesh`], counter-clockwise seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Its corners in [`Mesh::positions`].
    pub positions: [u32; 3],
    /// The normals of its corners in [`Mesh::normals`].
    pub normals: [u32; 3],
    /// What textures need of its corners, in [`Mesh::vertices`], where the mesh has any.
    pub vertices: [u32; 3],
    /// Its material in [`Scene::materials`](crate::Scene::materials).
    pub material: u32,
}

/// What a textured material needs at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Two sets of texture coordinates, from the upper left corner of a texture.
    pub uv: [Vec2; 2],
    /// The unit tangent in world space, and ±1: on which side of it the bitangent lies. All 0 where there is none.
    pub tangent: Vec4,
    /// What the base colour is multiplied with, linear.
    pub color: [f32; 4],
}

impl Default for Vertex {
    fn default() -> Self {
        Self { uv: [Vec2::ZERO; 2], tangent: Vec4::ZERO, color: [1.0; 4] }
    }
}

/// A surface of triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Points in world space, each coordinate at most [`MAX_COORDINATE`] in size.
    pub positions: Vec<Vec3>,
    /// Unit normals in world space.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, tangents and colours; empty for a mesh without.
    pub vertices: Vec<Vertex>,
    /// The triangles.
    pub triangles: Vec<Triangle>,
}

impl Mesh {
    /// A mesh of one material whose normals are the faces' own: it looks facetted.
    pub fn flat(positions: Vec<Vec3>, faces: &[[u32; 3]], material: u32) -> Result<Self, Error> {
        Self::with_shading(positions, faces, material, crate::Smoothing::Flat)
    }

    /// A mesh of one material with normals averaged around each point, across edges bent by up to `crease` degrees.
    pub fn smooth(positions: Vec<Vec3>, faces: &[[u32; 3]], material: u32, crease: f32) -> Result<Self, Error> {
        Self::with_shading(positions, faces, material, crate::Smoothing::Crease { degrees: crease })
    }

    fn with_shading(
        positions: Vec<Vec3>,
        faces: &[[u32; 3]],
        material: u32,
        smoothing: crate::Smoothing,
    ) -> Result<Self, Error> {
        let triangles = faces
            .iter()
            .map(|&positions| Triangle { positions, normals: [crate::normals::MISSING; 3], vertices: [0; 3], material })
            .collect();
        let mut mesh = Self { positions, triangles, ..Self::default() };
        mesh.check_positions()?;
        mesh.drop_degenerate();
        crate::normals::fill(&mut mesh, &[], smoothing);
        Ok(mesh)
    }

    /// The corners of a triangle. The mesh must have passed [`check`](Self::check).
    pub(crate) fn corners(&self, triangle: &Triangle) -> [Vec3; 3] {
        triangle.positions.map(|corner| self.positions[corner as usize])
    }

    /// Takes out triangles without an area (or with one that `f32` cannot hold) and says which were kept.
    pub(crate) fn drop_degenerate(&mut self) -> Vec<bool> {
        let kept: Vec<bool> = self.triangles.iter().map(|triangle| has_area(self.corners(triangle))).collect();
        let mut at = 0;
        self.triangles.retain(|_| {
            at += 1;
            kept[at - 1]
        });
        kept
    }

    /// Takes out triangles that lie exactly on an earlier one, facing the same way, and says which were kept.
    pub(crate) fn drop_duplicates(&mut self) -> Vec<bool> {
        let kept = first_in_place(self.triangles.par_iter().map(|triangle| self.corners(triangle)));
        let mut at = 0;
        self.triangles.retain(|_| {
            at += 1;
            kept[at - 1]
        });
        kept
    }

    /// The smallest box around all triangles, as its two extreme corners; `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let mut points = self
            .triangles
            .iter()
            .flat_map(|triangle| triangle.positions)
            .filter_map(|corner| self.positions.get(corner as usize).copied());
        let first = points.next()?;
        Some(points.fold((first, first), |(low, high), point| (low.min(point), high.max(point))))
    }

    fn check_positions(&self) -> Result<(), Error> {
        for (at, position) in self.positions.iter().enumerate() {
            if !position.abs().cmple(Vec3::splat(MAX_COORDINATE)).all() {
                return Err(Error::setting(
                    format!("position {at} of the mesh"),
                    position,
                    "its coordinates are finite and at most 1e9 in size",
                ));
            }
        }
        let count = self.positions.len();
        for (at, triangle) in self.triangles.iter().enumerate() {
            if let Some(&wrong) = triangle.positions.iter().find(|&&corner| corner as usize >= count) {
                return Err(Error::setting(
                    format!("a corner of triangle {at}"),
                    wrong,
                    format!("the mesh has {count} positions, counted from 0"),
                ));
            }
        }
        Ok(())
    }

    /// Whether all indices exist and all numbers are within their domain.
    ///
    /// # Errors
    /// [`Error::Setting`] with the first value that is not.
    pub fn check(&self, materials: usize) -> Result<(), Error> {
        self.check_positions()?;
        for (at, normal) in self.normals.iter().enumerate() {
            let is_unit = (normal.length_squared() - 1.0).abs() < 1e-3;
            if !is_unit {
                return Err(Error::setting(format!("normal {at} of the mesh"), normal, "its length is 1"));
            }
        }
        for (at, triangle) in self.triangles.iter().enumerate() {
            if let Some(&wrong) = triangle.normals.iter().find(|&&normal| normal as usize >= self.normals.len()) {
                return Err(Error::setting(
                    format!("a normal of triangle {at}"),
                    wrong,
                    format!("the mesh has {} normals, counted from 0", self.normals.len()),
                ));
            }
            let count = self.vertices.len();
            if let Some(&wrong) = triangle.vertices.iter().find(|&&vertex| count > 0 && vertex as usize >= count) {
                return Err(Error::setting(
                    format!("a vertex of triangle {at}"),
                    wrong,
                    format!("the mesh has {count} vertices, counted from 0"),
                ));
            }
            if triangle.material as usize >= materials {
                return Err(Error::setting(
                    format!("the material of triangle {at}"),
                    triangle.material,
                    format!("the scene has {materials} materials, counted from 0"),
                ));
            }
        }
        Ok(())
    }
}

/// For each triangle whether it is the first in its place, facing its way.
pub(crate) fn first_in_place(triangles: impl IndexedParallelIterator<Item = [Vec3; 3]>) -> Vec<bool> {
    let count = triangles.len();
    // Sorted and not hashed, which takes three times as long.
    let mut places: Vec<_> = triangles.map(place).zip(0..count).collect();
    places.par_sort_unstable();
    let mut is_first = vec![false; count];
    for same in places.chunk_by(|(a, _), (b, _)| a == b) {
        if let Some(first) = same.first().and_then(|(_, at)| is_first.get_mut(*at)) {
            *first = true;
        }
    }
    is_first
}

/// The same for triangles that have the same corners in the same sense of rotation, and different for all others.
fn place(corners: [Vec3; 3]) -> [[u32; 3]; 3] {
    // The sum makes −0 a 0.
    let bits = corners.map(|corner| (corner + 0.0).to_array().map(f32::to_bits));
    let [a, b, c] = bits;
    bits.min([b, c, a]).min([c, a, b])
}

/// Twice the area along the normal, in `f64`, where no coordinate up to [`MAX_COORDINATE`] overflows.
pub(crate) fn area_vector([a, b, c]: [Vec3; 3]) -> DVec3 {
    let a = a.as_dvec3();
    (b.as_dvec3() - a).cross(c.as_dvec3() - a)
}

fn has_area(corners: [Vec3; 3]) -> bool {
    area_vector(corners).length() >= f64::from(f32::MIN_POSITIVE)
}
