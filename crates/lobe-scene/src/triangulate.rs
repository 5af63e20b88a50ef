//! A polygon becomes triangles.
//!
//! A convex polygon is cut as a fan from its first corner; a concave one by clipping ears (Meisters,
//! *Polygons have ears*, 1975) in the plane that its area vector is most perpendicular to.

use glam::{DVec2, DVec3, Vec3};

/// The most corners for which ears are sought. The search takes corners², and a hostile file must not be
/// able to ask for hours: polygons beyond this are cut as a fan.
pub(crate) const MOST_CORNERS: usize = 2048;

/// How a polygon was cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Cut {
    /// The triangles tile the polygon.
    Exact,
    /// The polygon crosses itself, has no area or has too many corners: the triangles are a guess.
    Guess,
}

/// Cuts the polygon with these corners into `corners.len() − 2` triangles, given as indices of corners, and
/// appends them to `out`. Fewer than three corners give none.
pub(crate) fn triangulate(corners: &[Vec3], out: &mut Vec<[u32; 3]>) -> Cut {
    match corners.len() {
        0..=2 => return Cut::Exact,
        3 => {
            out.push([0, 1, 2]);
            return Cut::Exact;
        }
        _ => {}
    }
    let Some(points) = flatten(corners) else {
        fan(corners.len(), out);
        return Cut::Guess;
    };
    if is_convex(&points) {
        fan(corners.len(), out);
        return Cut::Exact;
    }
    if points.len() > MOST_CORNERS {
        fan(corners.len(), out);
        return Cut::Guess;
    }
    let cut = clip_ears(&points, out);
    if winds_once(&points) { cut } else { Cut::Guess }
}

fn fan(corners: usize, out: &mut Vec<[u32; 3]>) {
    out.extend((1..corners as u32 - 1).map(|corner| [0, corner, corner + 1]));
}

/// The polygon in two dimensions, turning left; `None` when it has no area.
fn flatten(corners: &[Vec3]) -> Option<Vec<DVec2>> {
    let first = corners.first()?.as_dvec3();
    // Newell's area vector: twice the area, along the normal, also for corners slightly off one plane.
    let mut area = DVec3::ZERO;
    for (at, corner) in corners.iter().enumerate() {
        let next = corners[(at + 1) % corners.len()];
        area += (corner.as_dvec3() - first).cross(next.as_dvec3() - first);
    }
    let size = area.abs();
    if size.max_element() <= 0.0 {
        return None;
    }
    // Dropping the longest component keeps the most area; the order of the other two keeps the turn to the left.
    let project = |point: DVec3| {
        if size.x >= size.y && size.x >= size.z {
            if area.x > 0.0 { DVec2::new(point.y, point.z) } else { DVec2::new(point.z, point.y) }
        } else if size.y >= size.z {
            if area.y > 0.0 { DVec2::new(point.z, point.x) } else { DVec2::new(point.x, point.z) }
        } else if area.z > 0.0 {
            DVec2::new(point.x, point.y)
        } else {
            DVec2::new(point.y, point.x)
        }
    };
    Some(corners.iter().map(|corner| project(corner.as_dvec3() - first)).collect())
}

/// Twice the signed area of a triangle: positive when it turns left.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Convex: every corner turns left, and the fan's triangles all do, which a star that winds twice fails.
fn is_convex(points: &[DVec2]) -> bool {
    let count = points.len();
    let corner = |at: usize| turn(points[at], points[(at + 1) % count], points[(at + 2) % count]) >= 0.0;
    let spoke = |at: usize| turn(points[0], points[at], points[at + 1]) >= 0.0;
    (0..count).all(corner) && (1..count - 1).all(spoke)
}

/// The outline of a polygon that does not cross itself turns by 2π in all; a bow tie turns by 0, a pentagram by 4π.
fn winds_once(points: &[DVec2]) -> bool {
    let next = points.iter().cycle().skip(1);
    let edges: Vec<DVec2> = points.iter().zip(next).map(|(a, b)| *b - *a).filter(|edge| *edge != DVec2::ZERO).collect();
    let following = edges.iter().cycle().skip(1);
    let turned: f64 = edges.iter().zip(following).map(|(a, b)| a.perp_dot(*b).atan2(a.dot(*b))).sum();
    (turned - std::f64::consts::TAU).abs() < 1.0
}

/// A ring of the corners that are left, with what is known of each.
struct Ring<'a> {
    points: &'a [DVec2],
    next: Vec<usize>,
    previous: Vec<usize>,
    reflex: Vec<bool>,
    ear: Vec<bool>,
}

impl Ring<'_> {
    fn classify(&mut self, at: usize) {
        let (before, after) = (self.previous[at], self.next[at]);
        let [a, b, c] = [before, at, after].map(|corner| self.points[corner]);
        self.reflex[at] = turn(a, b, c) <= 0.0;
        self.ear[at] = !self.reflex[at] && {
            // Only reflex corners can lie inside.
            let mut other = self.next[after];
            let mut free = true;
            while other != before {
                if self.reflex[other] {
                    let p = self.points[other];
                    let corner = p == a || p == b || p == c;
                    if !corner && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0 {
                        free = false;
                        break;
                    }
                }
                other = self.next[other];
            }
            free
        };
    }
}

fn clip_ears(points: &[DVec2], out: &mut Vec<[u32; 3]>) -> Cut {
    let count = points.len();
    let mut ring = Ring {
        points,
        next: (0..count).map(|at| (at + 1) % count).collect(),
        previous: (0..count).map(|at| (at + count - 1) % count).collect(),
        reflex: vec![false; count],
        ear: vec![false; count],
    };
    for at in 0..count {
        let [a, b, c] = [ring.previous[at], at, ring.next[at]].map(|corner| points[corner]);
        ring.reflex[at] = turn(a, b, c) <= 0.0;
    }
    for at in 0..count {
        ring.classify(at);
    }
    let mut cut = Cut::Exact;
    let mut at = 0;
    let mut left = count;
    let mut tried = 0;
    while left > 3 {
        if !ring.ear[at] {
            tried += 1;
            if tried < left {
                at = ring.next[at];
                continue;
            }
            // No ear is left. A corner on a straight line or a doubled one is cut off for nothing; anything
            // else means that the polygon crosses itself.
            let [a, b, c] = [ring.previous[at], at, ring.next[at]].map(|corner| points[corner]);
            if turn(a, b, c) != 0.0 {
                cut = Cut::Guess;
            }
        }
        let (before, after) = (ring.previous[at], ring.next[at]);
        out.push([before, at, after].map(|corner| corner as u32));
        ring.next[before] = after;
        ring.previous[after] = before;
        ring.classify(before);
        ring.classify(after);
        left -= 1;
        tried = 0;
        at = after;
    }
    out.push([ring.previous[at], at, ring.next[at]].map(|corner| corner as u32));
    cut
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn area(corners: &[Vec3], triangles: &[[u32; 3]]) -> (f64, f64) {
        let mut signed = DVec3::ZERO;
        let mut absolute = 0.0;
        for triangle in triangles {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize].as_dvec3());
            signed += (b - a).cross(c - a) / 2.0;
            absolute += (b - a).cross(c - a).length() / 2.0;
        }
        (signed.length(), absolute)
    }

    fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
        points.iter().map(|&[x, y]| Vec3::new(x, y, 3.0)).collect()
    }

    #[test]
    fn a_concave_polygon_is_tiled_exactly() {
        // An L, started at the worst corner for a fan, in both windings.
        let mut corners = flat(&[[2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0]]);
        for _ in 0..2 {
            let mut triangles = Vec::new();
            assert_eq!(triangulate(&corners, &mut triangles), Cut::Exact);
            assert_eq!(triangles.len(), 4);
            assert_eq!(area(&corners, &triangles), (3.0, 3.0));
            corners.reverse();
        }
    }

    #[test]
    fn a_star_a_bow_tie_and_a_point_are_guesses() {
        let bow_tie = flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.5]]);
        let point = flat(&[[1.0, 1.0]; 5]);
        let star: Vec<_> = (0..5).map(|at| (at as f32 * 4.0 * std::f32::consts::PI / 5.0).sin_cos().into()).collect();
        for polygon in [bow_tie, point, flat(&star)] {
            let mut triangles = Vec::new();
            assert_eq!(triangulate(&polygon, &mut triangles), Cut::Guess);
            assert_eq!(triangles.len(), polygon.len() - 2);
        }
    }

    proptest! {
        /// A polygon that is star-shaped about the origin is simple: signed and absolute area must agree.
        #[test]
        fn star_shaped_polygons_are_tiled(radii in prop::collection::vec(0.05_f32..1.0, 3..60), flip: bool) {
            let count = radii.len() as f32;
            let mut corners: Vec<Vec3> = radii.iter().enumerate().map(|(at, radius)| {
                let (y, x) = (at as f32 / count * std::f32::consts::TAU).sin_cos();
                Vec3::new(radius * x, 5.0, radius * y)
            }).collect();
            if flip { corners.reverse(); }
            let mut triangles = Vec::new();
            prop_assert_eq!(triangulate(&corners, &mut triangles), Cut::Exact);
            prop_assert_eq!(triangles.len(), corners.len() - 2);
            let (signed, absolute) = area(&corners, &triangles);
            prop_assert!((signed - absolute).abs() < 1e-6, "{} {}", signed, absolute);
        }

        #[test]
        fn any_points_give_all_but_two(points in prop::collection::vec((-3_i8..3, -3_i8..3, -3_i8..3), 3..40)) {
            let corners: Vec<Vec3> = points.iter().map(|&(x, y, z)| Vec3::new(x.into(), y.into(), z.into())).collect();
            let mut triangles = Vec::new();
            triangulate(&corners, &mut triangles);
            prop_assert_eq!(triangles.len(), corners.len() - 2);
            prop_assert!(triangles.iter().flatten().all(|&corner| (corner as usize) < corners.len()));
        }
    }
}
