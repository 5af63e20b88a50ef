//! Tangents for normal maps.

use crate::mesh::{Mesh, Triangle, Vertex};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::Vec4;

/// Tangents by Mikkelsen's method, which normal maps are baked for. A vertex each for every corner, since neighbours may
/// disagree.
pub(crate) fn fill(mesh: &mut Mesh, set: usize) {
    struct Corners<'m> {
        mesh: &'m Mesh,
        set: usize,
        found: Vec<Vec4>,
    }
    impl Corners<'_> {
        fn triangle(&self, face: usize) -> &Triangle {
            &self.mesh.triangles[face]
        }
    }
    impl Geometry for Corners<'_> {
        fn num_faces(&self) -> usize {
            self.mesh.triangles.len()
        }
        fn num_vertices_of_face(&self, _face: usize) -> usize {
            3
        }
        fn position(&self, face: usize, corner: usize) -> [f32; 3] {
            self.mesh.positions[self.triangle(face).positions[corner] as usize].into()
        }
        fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
            self.mesh.normals[self.triangle(face).normals[corner] as usize].into()
        }
        fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
            self.mesh.vertices[self.triangle(face).vertices[corner] as usize].uv[self.set].into()
        }
        fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
            if let (Some(space), Some(place)) = (space, self.found.get_mut(3 * face + corner)) {
                // The method takes v to point up, and glTF's points down.
                let [x, y, z, hand] = space.tangent_encoded();
                *place = Vec4::new(x, y, z, -hand);
            }
        }
    }
    let mut corners = Corners { mesh, set, found: vec![Vec4::ZERO; 3 * mesh.triangles.len()] };
    if generate_tangents(&mut corners).is_err() {
        return;
    }
    let found = corners.found;
    let mut vertices = Vec::with_capacity(found.len());
    for (triangle, tangents) in mesh.triangles.iter_mut().zip(found.chunks_exact(3)) {
        for (index, &tangent) in triangle.vertices.iter_mut().zip(tangents) {
            let old = mesh.vertices[*index as usize];
            *index = vertices.len() as u32;
            vertices.push(Vertex { tangent: if tangent.is_finite() { tangent } else { Vec4::ZERO }, ..old });
        }
    }
    mesh.vertices = vertices;
}
