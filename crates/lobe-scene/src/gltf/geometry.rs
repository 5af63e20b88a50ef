//! The meshes of a glTF file, in world space.

use super::accessor::{components, floats, indices};
use super::{MAX_TRIANGLES, Problem, Reader, name_of};
use crate::mesh::{MAX_COORDINATE, Mesh, Triangle, Vertex};
use crate::normals::{self, MISSING, Smoothing};
use crate::tangents;
use ::gltf::mesh::Mode;
use ::gltf::{Primitive, Semantic};
use glam::{DMat3, DMat4, Vec2, Vec3, Vec4};

/// What a primitive has for each of its points.
struct Points {
    positions: Vec<Vec3>,
    normals: Option<Vec<Vec3>>,
    vertices: Vec<Vertex>,
    has_tangents: bool,
}

impl Reader<'_> {
    /// Adds a mesh, moved to its place.
    pub(super) fn mesh(&mut self, mesh: &::gltf::Mesh<'_>, world: DMat4) -> Result<(), Problem> {
        let name = name_of("mesh", mesh.name(), mesh.index());
        for (at, primitive) in mesh.primitives().enumerate() {
            let what = if mesh.primitives().len() == 1 { name.clone() } else { format!("{name}, part {at}") };
            if primitive.morph_targets().next().is_some() {
                self.once(format!("{name} has morph targets; it is shown without"));
            }
            if primitive.extension_value("KHR_draco_mesh_compression").is_some() {
                self.once(format!("{what} is compressed by Draco, which is not supported; it is left out"));
                continue;
            }
            if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
                self.once(format!("{what} is made of points or lines, and is left out"));
                continue;
            }
            self.primitive(&primitive, &what, world)
                .map_err(|Problem(problem)| Problem(format!("{what}: {problem}")))?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive<'_>, what: &str, world: DMat4) -> Result<(), Problem> {
        let Some(accessor) = primitive.get(&Semantic::Positions) else {
            self.once(format!("{what} has no positions, and is left out"));
            return Ok(());
        };
        let flips = world.determinant() < 0.0;
        // First of all: that there are so many is only stated so far.
        let positions = floats::<3>(&accessor, &self.buffers)?;
        let count = positions.len();
        let corners = match primitive.indices() {
            Some(accessor) => indices(&accessor, &self.buffers)?,
            None => (0..u32::try_from(count).map_err(|_| Problem(format!("it has {count} points")))?).collect(),
        };
        if let Some(wrong) = corners.iter().find(|&&corner| corner as usize >= count) {
            return Err(Problem(format!("it has the index {wrong}, and {count} points, counted from 0")));
        }
        let faces = faces(&corners, primitive.mode(), flips);
        // Copies of a mesh are made of a few bytes of the file, and take many of memory.
        self.triangles = self.triangles.saturating_add(faces.len());
        self.points = self.points.saturating_add(count);
        if self.triangles > MAX_TRIANGLES || self.points > 3 * MAX_TRIANGLES {
            let (triangles, points) = (self.triangles, self.points);
            return Err(Problem(format!(
                "with it the scene has {triangles} triangles and {points} points, copies counted; at most \
                 {MAX_TRIANGLES} and three times as many are read"
            )));
        }
        let material = primitive.material().index().map_or_else(|| self.default_material(), |index| index as u32);
        let points = self.points(primitive, &positions, what, world)?;

        // Without normals a surface is flat: section 3.7.2.1.
        let usable = |at: u32| points.normals.as_ref().is_some_and(|normals| normals[at as usize] != Vec3::ZERO);
        let triangles = faces.iter().map(|&positions| Triangle {
            positions,
            normals: positions.map(|at| if usable(at) { at } else { MISSING }),
            vertices: positions,
            material,
        });
        let mut mesh = Mesh {
            triangles: triangles.collect(),
            positions: points.positions,
            vertices: points.vertices,
            // Those that are not there are never named.
            normals: points.normals.map_or_else(Vec::new, |normals| {
                normals.into_iter().map(|normal| if normal == Vec3::ZERO { Vec3::Z } else { normal }).collect()
            }),
        };
        let kept = mesh.drop_degenerate();
        if kept.iter().all(|kept| !kept) {
            self.once(format!("{what} has no triangle with an area, and is left out"));
            return Ok(());
        }
        if mesh.positions.len() > 3 * mesh.triangles.len() {
            keep_what_is_used(&mut mesh);
        }
        normals::fill(&mut mesh, &[], Smoothing::Flat);
        if !points.has_tangents && self.needs_tangents(material) && !mesh.vertices.is_empty() {
            let set = self.tangent_set(material);
            tangents::fill(&mut mesh, set);
        }
        self.scene.meshes.push(mesh);
        Ok(())
    }

    fn points(
        &mut self,
        primitive: &Primitive<'_>,
        positions: &[[f32; 3]],
        what: &str,
        world: DMat4,
    ) -> Result<Points, Problem> {
        let count = positions.len();
        let place = |point: &[f32; 3]| world.transform_point3(Vec3::from(*point).as_dvec3()).as_vec3();
        let positions: Vec<Vec3> = positions.iter().map(place).collect();
        if let Some((at, position)) =
            positions.iter().enumerate().find(|(_, p)| !p.abs().cmple(Vec3::splat(MAX_COORDINATE)).all())
        {
            return Err(Problem(format!(
                "point {at} is at {position}; coordinates are finite and at most 1e9 in size"
            )));
        }
        // Normals turn with the inverse transposed; the adjugate is that but for a factor, and has no division.
        let linear = DMat3::from_mat4(world);
        let adjugate = DMat3::from_cols(
            linear.y_axis.cross(linear.z_axis),
            linear.z_axis.cross(linear.x_axis),
            linear.x_axis.cross(linear.y_axis),
        );
        let sign = if world.determinant() < 0.0 { -1.0 } else { 1.0 };
        let normals = match self.attribute::<3>(primitive, &Semantic::Normals, count)? {
            Some(normals) => {
                let unit = |n: [f32; 3]| (adjugate * Vec3::from(n).as_dvec3() * sign).try_normalize();
                let normals: Vec<_> = normals.into_iter().map(unit).collect();
                if normals.iter().any(Option::is_none) {
                    self.once(format!("{what} has normals without a direction; its triangles' own stand in for them"));
                }
                Some(normals.into_iter().map(|n| n.map_or(Vec3::ZERO, |n| n.as_vec3())).collect())
            }
            None => None,
        };
        let uvs = [0, 1].map(|set| self.attribute::<2>(primitive, &Semantic::TexCoords(set), count));
        let [first, second] = uvs;
        let (first, second) = (first?, second?);
        let given = self.attribute::<4>(primitive, &Semantic::Tangents, count)?;
        let colors = self.colors(primitive, count)?;
        let mut vertices = Vec::new();
        if first.is_some() || second.is_some() || given.is_some() || colors.is_some() {
            let uv = |set: &Option<Vec<[f32; 2]>>, at: usize| {
                let uv = set.as_ref().map_or(Vec2::ZERO, |set| set[at].into());
                if uv.is_finite() { uv } else { Vec2::ZERO }
            };
            vertices = (0..count)
                .map(|at| Vertex {
                    uv: [uv(&first, at), uv(&second, at)],
                    tangent: given.as_ref().map_or(Vec4::ZERO, |given| {
                        let [x, y, z, w] = given[at];
                        let along = (linear * Vec3::new(x, y, z).as_dvec3()).try_normalize();
                        let handed = if (w < 0.0) == (sign < 0.0) { 1.0 } else { -1.0 };
                        along.map_or(Vec4::ZERO, |along| along.as_vec3().extend(handed))
                    }),
                    color: colors.as_ref().map_or([1.0; 4], |colors| colors[at]),
                })
                .collect();
        }
        Ok(Points { positions, normals, vertices, has_tangents: given.is_some() })
    }

    /// The numbers of an attribute, one for each point, if it is there.
    fn attribute<const N: usize>(
        &self,
        primitive: &Primitive<'_>,
        semantic: &Semantic,
        count: usize,
    ) -> Result<Option<Vec<[f32; N]>>, Problem> {
        let Some(accessor) = primitive.get(semantic) else { return Ok(None) };
        if accessor.count() != count {
            let found = accessor.count();
            return Err(Problem(format!("accessor {} has {found} elements for {count} points", accessor.index())));
        }
        floats(&accessor, &self.buffers).map(Some)
    }

    /// `COLOR_0`, of three or four components.
    fn colors(&self, primitive: &Primitive<'_>, count: usize) -> Result<Option<Vec<[f32; 4]>>, Problem> {
        let semantic = Semantic::Colors(0);
        let Some(accessor) = primitive.get(&semantic) else { return Ok(None) };
        let clean = |c: f32| if c >= 0.0 && c.is_finite() { c } else { 1.0 };
        let colors = match components(accessor.dimensions()) {
            Some(3) => self
                .attribute::<3>(primitive, &semantic, count)?
                .map(|all| all.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect()),
            _ => self.attribute::<4>(primitive, &semantic, count)?,
        };
        Ok(colors.map(|colors: Vec<[f32; 4]>| colors.into_iter().map(|color| color.map(clean)).collect()))
    }
}

/// Drops the points that no triangle has: an accessor without data states millions of them in a few bytes. Normals and
/// vertices have the indices of the points here.
fn keep_what_is_used(mesh: &mut Mesh) {
    let old = std::mem::take(mesh);
    for triangle in old.triangles {
        let first = mesh.positions.len() as u32;
        let mut place = [0; 3];
        for ((from, to), index) in triangle.positions.into_iter().zip(&mut place).zip(first..) {
            *to = index;
            mesh.positions.extend(old.positions.get(from as usize));
            mesh.normals.extend(old.normals.get(from as usize));
            mesh.vertices.extend(old.vertices.get(from as usize));
        }
        let normals = [0, 1, 2].map(|i| if triangle.normals[i] == MISSING { MISSING } else { place[i] });
        mesh.triangles.push(Triangle { positions: place, normals, vertices: place, material: triangle.material });
    }
}

/// The corners of each triangle, counter-clockwise from outside.
fn faces(corners: &[u32], mode: Mode, flips: bool) -> Vec<[u32; 3]> {
    let mut faces: Vec<[u32; 3]> = match mode {
        Mode::Triangles => corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect(),
        // Every second one is the other way round: section 3.7.2.1.
        Mode::TriangleStrip => {
            let turned = |(at, face): (usize, &[u32])| match at % 2 {
                0 => [face[0], face[1], face[2]],
                _ => [face[0], face[2], face[1]],
            };
            corners.windows(3).enumerate().map(turned).collect()
        }
        Mode::TriangleFan => match corners.split_first() {
            Some((&first, rest)) => rest.windows(2).map(|edge| [edge[0], edge[1], first]).collect(),
            None => Vec::new(),
        },
        _ => Vec::new(),
    };
    if flips {
        faces.iter_mut().for_each(|face| face.swap(1, 2));
    }
    faces
}
