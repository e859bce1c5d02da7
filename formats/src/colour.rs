//! Colours as files write them, and as 8 bits a channel.

/// What the numbers of a colour mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Scale {
    /// 0 to 255.
    Bytes,
    /// 0 to 65535 if any number of the file is above 255, else 0 to 255.
    Words,
    /// 0 to 1.
    Unit,
    /// 0 to 1 if no number of the whole file is above 1, else 0 to 255.
    ///
    /// Text formats do not say, and programs that mean 0 to 1 write `1 0 0` without a point. A file
    /// of whole numbers that means 0 to 255 and has none above 1 would be all but black.
    #[default]
    Guessed,
}

/// The colours of the faces, or of the points, of a file, gathered one by one.
///
/// Takes no memory until the first colour comes.
#[derive(Debug, Default)]
pub(crate) struct Colours {
    /// Red, green, blue; not a number where there is no colour.
    values: Vec<[f32; 3]>,
    /// How many came before the first colour.
    leading: usize,
    largest: f32,
}

const NONE: [f32; 3] = [f32::NAN; 3];

impl Colours {
    /// Adds the colour of the next face or point.
    #[inline]
    pub(crate) fn push(&mut self, colour: Option<[f32; 3]>) {
        if let Some(colour) = colour {
            if self.values.is_empty() {
                self.values.resize(self.leading, NONE);
            }
            self.largest = colour.into_iter().fold(self.largest, f32::max);
            self.values.push(colour);
        } else if self.values.is_empty() {
            self.leading += 1;
        } else {
            self.values.push(NONE);
        }
    }

    /// The colours of faces; empty if there is none.
    pub(crate) fn of_faces(self, scale: Scale) -> Vec<Option<[u8; 3]>> {
        let factor = self.factor(scale);
        let convert = |colour: [f32; 3]| {
            (!colour[0].is_nan()).then(|| colour.map(|channel| to_byte(channel * factor)))
        };
        self.values.into_iter().map(convert).collect()
    }

    /// The colours of points; white where a point has none, empty if no point has one.
    pub(crate) fn of_points(self, scale: Scale) -> Vec<[u8; 3]> {
        let white = [255; 3];
        self.of_faces(scale).into_iter().map(|colour| colour.unwrap_or(white)).collect()
    }

    fn factor(&self, scale: Scale) -> f32 {
        match scale {
            Scale::Bytes => 1.0,
            Scale::Words if self.largest > 255.0 => 255.0 / 65535.0,
            Scale::Words => 1.0,
            Scale::Unit => 255.0,
            Scale::Guessed if self.largest <= 1.0 => 255.0,
            Scale::Guessed => 1.0,
        }
    }
}

/// A channel of 0 to 255 as a byte; what lies outside is cut off.
pub(crate) fn to_byte(channel: f32) -> u8 {
    channel.round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gathered(colours: &[Option<[f32; 3]>]) -> Colours {
        let mut gathered = Colours::default();
        for colour in colours {
            gathered.push(*colour);
        }
        gathered
    }

    #[test]
    fn the_scale_is_guessed_from_the_largest_number() {
        let unit = [None, Some([1.0, 0.5, 0.0]), None];
        assert_eq!(gathered(&unit).of_faces(Scale::Guessed), [None, Some([255, 128, 0]), None]);
        let bytes = [Some([1.0, 0.0, 0.0]), Some([0.0, 200.0, 0.0])];
        assert_eq!(gathered(&bytes).of_faces(Scale::Guessed), [Some([1, 0, 0]), Some([0, 200, 0])]);
    }

    #[test]
    fn without_a_colour_there_is_no_carrier() {
        assert_eq!(gathered(&[None, None]).of_points(Scale::Guessed), Vec::<[u8; 3]>::new());
    }

    #[test]
    fn points_without_a_colour_are_white_and_channels_are_cut_off() {
        let points = [None, Some([300.0, -5.0, 7.4])];
        assert_eq!(gathered(&points).of_points(Scale::Bytes), [[255; 3], [255, 0, 7]]);
    }
}
