//! Outlines of rolled and welded sections, as lines and arcs.
//!
//! Measures follow the product standards (EN 10365 for I and channels, EN
//! 10056 for angles): `height` along y, `width` along x, corner and root radii
//! as tables give them.  The origin is the centroid, so that the axis of the
//! beam is its centroidal axis.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Point2;

use super::error::BodyError;
use super::outline::{Outline, Path, Segment, positive};
use super::piece::SHORTEST;

/// A polygon corner and the radius it is rounded with; 0 leaves it sharp.
type Corner = (f64, f64, f64);

impl Path {
    /// A rectangle with sharp corners.
    ///
    /// # Errors
    /// If a measure is not positive and finite.
    pub fn rectangle(width: f64, height: f64) -> Result<Self, BodyError> {
        Self::rounded_rectangle(width, height, 0.0)
    }

    /// A rectangle with all corners rounded by the same radius, which may be 0.
    ///
    /// # Errors
    /// If a side is not positive and finite or the radius does not fit.
    pub fn rounded_rectangle(width: f64, height: f64, radius: f64) -> Result<Self, BodyError> {
        positive("a width", width)?;
        positive("a height", height)?;
        let (x, y) = (0.5 * width, 0.5 * height);
        rounded(&[(x, -y, radius), (x, y, radius), (-x, y, radius), (-x, -y, radius)])
    }

    /// An I section with parallel flanges: IPE, HEA, HEB, W.
    ///
    /// # Errors
    /// If a measure is not positive and finite or the fillets do not fit.
    pub fn i_section(
        height: f64,
        width: f64,
        web: f64,
        flange: f64,
        root_radius: f64,
    ) -> Result<Self, BodyError> {
        check_walls(&[height, width, web, flange])?;
        let (x, y, w, f, r) = (0.5 * width, 0.5 * height, 0.5 * web, flange, root_radius);
        let right = [
            (x, -y, 0.0),
            (x, f - y, 0.0),
            (w, f - y, r),
            (w, y - f, r),
            (x, y - f, 0.0),
            (x, y, 0.0),
        ];
        let left = right.iter().rev().map(|&(x, y, r)| (-x, y, r));
        rounded(&right.iter().copied().chain(left).collect::<Vec<_>>())
    }

    /// A channel with parallel flanges, open towards +x: UPE, PFC.
    ///
    /// # Errors
    /// If a measure is not positive and finite or the fillets do not fit.
    pub fn channel(
        height: f64,
        width: f64,
        web: f64,
        flange: f64,
        root_radius: f64,
    ) -> Result<Self, BodyError> {
        check_walls(&[height, width, web, flange])?;
        let (y, f, r) = (0.5 * height, flange, root_radius);
        rounded(&[
            (0.0, -y, 0.0),
            (width, -y, 0.0),
            (width, f - y, 0.0),
            (web, f - y, r),
            (web, y - f, r),
            (width, y - f, 0.0),
            (width, y, 0.0),
            (0.0, y, 0.0),
        ])?
        .about_centroid()
    }

    /// An angle with legs along +x (`width`) and +y (`height`).
    ///
    /// # Errors
    /// If a measure is not positive and finite or the radii do not fit.
    pub fn angle(
        height: f64,
        width: f64,
        thickness: f64,
        root_radius: f64,
        toe_radius: f64,
    ) -> Result<Self, BodyError> {
        check_walls(&[height, width, thickness, thickness])?;
        let t = thickness;
        rounded(&[
            (0.0, 0.0, 0.0),
            (width, 0.0, 0.0),
            (width, t, toe_radius),
            (t, t, root_radius),
            (t, height, toe_radius),
            (0.0, height, 0.0),
        ])?
        .about_centroid()
    }

    /// The same path with its centroid at the origin.
    ///
    /// # Errors
    /// If the path encloses no area.
    pub fn about_centroid(&self) -> Result<Self, BodyError> {
        let shift = Outline::Path(self.clone()).centroid()?.coords;
        let segments = self.segments.iter().map(|segment| match *segment {
            Segment::Line { to } => Segment::Line { to: to - shift },
            Segment::Arc { to, sweep } => Segment::Arc { to: to - shift, sweep },
        });
        Ok(Self { start: self.start - shift, segments: segments.collect() })
    }
}

/// Refuses walls that are not positive, or thicker than the section they are in.
fn check_walls(&[height, width, web, flange]: &[f64; 4]) -> Result<(), BodyError> {
    positive("a height", height)?;
    positive("a width", width)?;
    positive("a wall", web)?;
    positive("a wall", flange)?;
    positive("the room beside the web", width - web)?;
    positive("the room between the flanges", height - flange)
}

/// Rounds the corners of a polygon whose sides are parallel to the axes.
///
/// A corner of radius r begins and ends r before and after its sharp point;
/// the side between two roundings is left out if nothing remains of it.
fn rounded(corners: &[Corner]) -> Result<Path, BodyError> {
    let n = corners.len();
    let mut chain: Vec<(Point2<f64>, Option<f64>)> = Vec::with_capacity(2 * n);
    for (i, &(x, y, radius)) in corners.iter().enumerate() {
        let at = Point2::new(x, y);
        if radius == 0.0 {
            chain.push((at, None));
            continue;
        }
        positive("a radius", radius)?;
        let neighbour = |j: usize| Point2::new(corners[j].0, corners[j].1);
        let (before, after) = (neighbour((i + n - 1) % n) - at, neighbour((i + 1) % n) - at);
        let reach = |j: usize, length: f64| length - radius - corners[j].2;
        let room = reach((i + n - 1) % n, before.norm()).min(reach((i + 1) % n, after.norm()));
        if room < -SHORTEST {
            return Err(BodyError::NotPositive {
                what: "the side left between two radii",
                value: room,
            });
        }
        let turn = -before.perp(&after).signum() * FRAC_PI_2;
        chain.push((at + before.normalize() * radius, None));
        chain.push((at + after.normalize() * radius, Some(turn)));
    }
    Ok(path_of(&chain))
}

fn path_of(chain: &[(Point2<f64>, Option<f64>)]) -> Path {
    let start = chain[0].0;
    let mut at = start;
    let mut segments = Vec::with_capacity(chain.len() + 1);
    for &(to, sweep) in &chain[1..] {
        match sweep {
            Some(sweep) => segments.push(Segment::Arc { to, sweep }),
            None if (to - at).norm() < SHORTEST => continue,
            None => segments.push(Segment::Line { to }),
        }
        at = to;
    }
    if let Some(Segment::Arc { to, .. }) = segments.last_mut() {
        // The last rounding may end where the first begins.
        if (*to - start).norm() < SHORTEST {
            *to = start;
        }
    }
    Path { start, segments }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn area(path: Path) -> f64 {
        Outline::Path(path).area().unwrap()
    }

    #[test]
    fn rounded_rectangle_lacks_its_corners() {
        let path = Path::rounded_rectangle(60.0, 40.0, 8.0).unwrap();
        assert!((area(path) - (2400.0 - (4.0 - PI) * 64.0)).abs() < 1e-10);
    }

    #[test]
    fn stadium_has_no_sides_between_its_half_rounds() {
        let path = Path::rounded_rectangle(60.0, 40.0, 20.0).unwrap();
        assert_eq!(path.segments.len(), 5); // the sixth joins the end to the start
        assert!((area(path) - (20.0 * 40.0 + PI * 400.0)).abs() < 1e-10);
    }

    #[test]
    fn ipe_200_has_the_area_of_the_table() {
        // EN 10365: IPE 200, h = 200, b = 100, tw = 5.6, tf = 8.5, r = 12: A = 28.5 cm².
        let path = Path::i_section(200.0, 100.0, 5.6, 8.5, 12.0).unwrap();
        assert!((area(path) / 100.0 - 28.5).abs() < 0.05);
    }

    #[test]
    fn upe_200_has_the_area_of_the_table() {
        // EN 10365: UPE 200, h = 200, b = 80, tw = 6, tf = 11, r = 13: A = 29.0 cm².
        let path = Path::channel(200.0, 80.0, 6.0, 11.0, 13.0).unwrap();
        assert!((area(path) / 100.0 - 29.0).abs() < 0.05);
    }

    #[test]
    fn angle_50_5_has_the_area_and_centroid_of_the_table() {
        // EN 10056-1: L 50x50x5, r1 = 7, r2 = 3.5: A = 4.80 cm², e = 1.40 cm.
        let path = Path::angle(50.0, 50.0, 5.0, 7.0, 3.5).unwrap();
        assert!((path.start.x / 10.0 + 1.40).abs() < 0.005);
        assert!((area(path) / 100.0 - 4.80).abs() < 0.005);
    }

    #[test]
    fn radius_that_does_not_fit_is_refused() {
        assert!(matches!(
            Path::rounded_rectangle(60.0, 40.0, 21.0),
            Err(BodyError::NotPositive { .. })
        ));
    }
}
