//! What one element of a PLY file is read into.

use ply_rs_bw::ply::{BeginList, PropertyAccess, PropertyAccessResult};

use super::columns::Slot;

/// An element that takes single numbers.
pub(super) trait Record: PropertyAccess {
    /// Takes an integer.
    fn integer(&mut self, slot: Slot, value: i64);
    /// Takes a number of a floating-point type.
    fn real(&mut self, slot: Slot, value: f64);
}

/// A point.
#[derive(Debug, Default)]
pub(super) struct Point {
    pub(super) position: [f64; 3],
    colour: [f32; 3],
    /// How many of red, green and blue came.
    channels: u8,
}

impl Point {
    /// The colour, if the file has all three channels.
    pub(super) fn colour(&self) -> Option<[f32; 3]> {
        (self.channels == 3).then_some(self.colour)
    }
}

impl Record for Point {
    #[inline]
    fn integer(&mut self, slot: Slot, value: i64) {
        self.real(slot, value as f64);
    }

    #[inline]
    fn real(&mut self, slot: Slot, value: f64) {
        match slot {
            Slot::X => self.position[0] = value,
            Slot::Y => self.position[1] = value,
            Slot::Z => self.position[2] = value,
            _ => {
                if let Some(channel) = channel(slot) {
                    self.colour[channel] = value as f32;
                    self.channels += 1;
                }
            }
        }
    }
}

/// A face.
#[derive(Debug, Default)]
pub(super) struct Face {
    pub(super) colour: [f32; 3],
    pub(super) flags: i64,
    pub(super) quality: f32,
    pub(super) non_design: i64,
    pub(super) label: i64,
    /// Corners; by the type in the file one of these three is filled.
    signed: Vec<i32>,
    unsigned: Vec<u32>,
    short: Vec<i64>,
}

impl Face {
    /// The corners of a face read from binary data, as they stand in the file.
    pub(super) fn corners(&self) -> impl Iterator<Item = i64> {
        let signed = self.signed.iter().map(|&index| i64::from(index));
        let unsigned = self.unsigned.iter().map(|&index| i64::from(index));
        signed.chain(unsigned).chain(self.short.iter().copied())
    }

    fn short_corners<T: Into<i64>>(&mut self, name: &str, values: Vec<T>) -> PropertyAccessResult {
        if Slot::of_name(name) == Slot::Corners {
            self.short = values.into_iter().map(Into::into).collect();
        }
        PropertyAccessResult::Set
    }
}

impl Record for Face {
    #[inline]
    fn integer(&mut self, slot: Slot, value: i64) {
        match slot {
            Slot::Flags => self.flags = value,
            Slot::NonDesign => self.non_design = value,
            Slot::Label => self.label = value,
            _ => self.real(slot, value as f64),
        }
    }

    #[inline]
    fn real(&mut self, slot: Slot, value: f64) {
        match slot {
            Slot::Quality => self.quality = value as f32,
            Slot::NonDesign => self.non_design = i64::from(value != 0.0 && !value.is_nan()),
            _ => {
                if let Some(channel) = channel(slot) {
                    self.colour[channel] = value as f32;
                }
            }
        }
    }
}

fn channel(slot: Slot) -> Option<usize> {
    match slot {
        Slot::Red => Some(0),
        Slot::Green => Some(1),
        Slot::Blue => Some(2),
        _ => None,
    }
}

/// An element that is passed over.
#[derive(Debug, Default)]
pub(super) struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

/// The setters that `ply-rs-bw` calls, one for each type of number, lead to [`Record`].
macro_rules! single_numbers {
    () => {
        fn new() -> Self {
            Self::default()
        }
        single_numbers! {
            integer: set_char(i8), set_uchar(u8), set_short(i16), set_ushort(u16), set_int(i32),
            set_uint(u32)
        }
        single_numbers! { real: set_float(f32), set_double(f64) }
    };
    ($take:ident: $($setter:ident($number:ty)),+) => {
        $(
            #[inline]
            fn $setter(&mut self, name: &str, value: $number) -> PropertyAccessResult {
                self.$take(Slot::of_name(name), value.into());
                PropertyAccessResult::Set
            }
        )+
    };
}

impl PropertyAccess for Point {
    single_numbers!();
}

impl PropertyAccess for Face {
    single_numbers!();

    #[inline]
    fn begin_list_int(&mut self, name: &str, _: usize) -> BeginList<'_, i32> {
        match Slot::of_name(name) {
            Slot::Corners => BeginList::Fill(&mut self.signed),
            _ => BeginList::UseSetter,
        }
    }

    #[inline]
    fn begin_list_uint(&mut self, name: &str, _: usize) -> BeginList<'_, u32> {
        match Slot::of_name(name) {
            Slot::Corners => BeginList::Fill(&mut self.unsigned),
            _ => BeginList::UseSetter,
        }
    }

    fn set_list_char(&mut self, name: &str, values: Vec<i8>) -> PropertyAccessResult {
        self.short_corners(name, values)
    }

    fn set_list_uchar(&mut self, name: &str, values: Vec<u8>) -> PropertyAccessResult {
        self.short_corners(name, values)
    }

    fn set_list_short(&mut self, name: &str, values: Vec<i16>) -> PropertyAccessResult {
        self.short_corners(name, values)
    }

    fn set_list_ushort(&mut self, name: &str, values: Vec<u16>) -> PropertyAccessResult {
        self.short_corners(name, values)
    }
}
