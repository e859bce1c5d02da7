//! A file as the readers see it: a stream of bytes or of lines that knows how far it has come.

use std::fs::File;
use std::io::{self, BufRead, Read};
use std::ops::Range;
use std::path::Path;

use crate::error::{Place, ReadError};
use crate::line::Line;

/// Bytes read at once; enough to make the system calls cheap, small enough for the cache.
const BLOCK: usize = 256 * 1024;

/// A file being read, in blocks: memory is one block, or the longest line if that is longer.
pub(crate) struct Input<'a> {
    path: &'a Path,
    size: u64,
    source: Box<dyn Read + 'a>,
    block: Vec<u8>,
    /// The part of `block` that was read from the file and not yet handed out.
    unread: Range<usize>,
    /// Bytes of the file before `block`.
    before: u64,
    lines: u64,
}

impl<'a> Input<'a> {
    /// Opens a file of at most `max_bytes`.
    pub(crate) fn open(path: &'a Path, max_bytes: u64) -> Result<Self, ReadError> {
        let io = |source| ReadError::Io { path: path.to_owned(), source };
        // Asked before opening: opening a named pipe would wait for somebody to write into it.
        let kind = path.metadata().map_err(io)?;
        if !kind.is_file() {
            let what = if kind.is_dir() { "directory" } else { "device or pipe" };
            return Err(ReadError::NotAFile { path: path.to_owned(), what });
        }
        let file = File::open(path).map_err(io)?;
        Self::new(path, Box::new(file), kind.len(), max_bytes)
    }

    /// Reads from memory; `path` is for messages.
    pub(crate) fn from_bytes(
        path: &'a Path,
        bytes: &'a [u8],
        max_bytes: u64,
    ) -> Result<Self, ReadError> {
        Self::new(path, Box::new(bytes), bytes.len() as u64, max_bytes)
    }

    fn new(
        path: &'a Path,
        source: Box<dyn Read + 'a>,
        size: u64,
        max_bytes: u64,
    ) -> Result<Self, ReadError> {
        if size > max_bytes {
            return Err(ReadError::TooLarge { path: path.to_owned(), size, limit: max_bytes });
        }
        if size == 0 {
            return Err(ReadError::Empty { path: path.to_owned() });
        }
        Ok(Self { path, size, source, block: Vec::new(), unread: 0..0, before: 0, lines: 0 })
    }

    /// The file, for messages.
    pub(crate) fn path(&self) -> &'a Path {
        self.path
    }

    /// Size of the file in bytes.
    pub(crate) fn size(&self) -> u64 {
        self.size
    }

    /// Bytes handed out so far.
    pub(crate) fn position(&self) -> u64 {
        self.before + self.unread.start as u64
    }

    /// Bytes still to come, by the size the file had when it was opened.
    pub(crate) fn remaining(&self) -> u64 {
        self.size.saturating_sub(self.position())
    }

    /// Lines handed out so far.
    pub(crate) fn line_number(&self) -> u64 {
        self.lines
    }

    /// The error of a text file that ends before `missing`.
    pub(crate) fn cut_off(&self, missing: impl Into<String>) -> ReadError {
        let place = Place::Line(self.lines);
        ReadError::CutOff { path: self.path.to_owned(), place, missing: missing.into() }
    }

    /// An error of the operating system while reading.
    pub(crate) fn io_error(&self, source: io::Error) -> ReadError {
        ReadError::Io { path: self.path.to_owned(), source }
    }

    /// The next `count` bytes, or all that are left, without taking them.
    pub(crate) fn peek(&mut self, count: usize) -> Result<&[u8], ReadError> {
        while self.unread.len() < count {
            if self.read_more().map_err(|source| self.io_error(source))? == 0 {
                break;
            }
        }
        Ok(&self.block[self.unread.start..self.unread.end.min(self.unread.start + count)])
    }

    /// Takes `count` bytes that were peeked at.
    pub(crate) fn skip(&mut self, count: usize) {
        self.unread.start = self.unread.end.min(self.unread.start + count);
    }

    /// Passes over the mark that some editors put before UTF-8 text.
    pub(crate) fn skip_byte_order_mark(&mut self) -> Result<(), ReadError> {
        if self.peek(3)? == b"\xef\xbb\xbf" {
            self.skip(3);
        }
        Ok(())
    }

    /// The next line, whether it ends in LF, CR LF or CR; `None` at the end of the file.
    pub(crate) fn next_line(&mut self) -> Result<Option<Line<'_>>, ReadError> {
        let range = self.advance_line()?;
        Ok(range.map(|range| self.line(range)))
    }

    /// The next line of a file whose lines end in CR alone; what follows may be binary.
    pub(crate) fn next_cr_line(&mut self) -> Result<Option<Line<'_>>, ReadError> {
        let mut window = 256;
        loop {
            let text = self.peek(window)?;
            let available = text.len();
            if let Some(length) = memchr::memchr(b'\r', text) {
                let start = self.unread.start;
                self.skip(length + 1);
                self.lines += 1;
                return Ok(Some(self.line(start..start + length)));
            }
            if available < window {
                return Ok(None);
            }
            window *= 2;
        }
    }

    /// The next line that has more than blanks and a comment, without these.
    ///
    /// A comment goes from `#` to the end of the line.
    pub(crate) fn next_content(&mut self) -> Result<Option<Line<'_>>, ReadError> {
        loop {
            let Some(range) = self.advance_line()? else { return Ok(None) };
            let line = &self.block[range.clone()];
            let content = &line[..memchr::memchr(b'#', line).unwrap_or(line.len())];
            let kept = content.trim_ascii();
            if !kept.is_empty() {
                let start = range.start + content.len() - content.trim_ascii_start().len();
                return Ok(Some(self.line(start..start + kept.len())));
            }
        }
    }

    fn line(&self, range: Range<usize>) -> Line<'_> {
        Line { text: &self.block[range], number: self.lines, path: self.path }
    }

    /// Takes one line with its end; the range is that of the line in `block` without its end.
    fn advance_line(&mut self) -> Result<Option<Range<usize>>, ReadError> {
        let mut searched = 0;
        let (length, end) = loop {
            let unsearched = &self.block[self.unread.start + searched..self.unread.end];
            if let Some(found) = memchr::memchr2(b'\n', b'\r', unsearched) {
                let length = searched + found;
                break (length, self.length_of_line_end(length)?);
            }
            searched = self.unread.len();
            if self.read_more().map_err(|source| self.io_error(source))? == 0 {
                break (searched, 0);
            }
        };
        if length + end == 0 {
            return Ok(None);
        }
        let range = self.unread.start..self.unread.start + length;
        self.unread.start += length + end;
        self.lines += 1;
        Ok(Some(range))
    }

    /// Length of the line end that begins `at` bytes after the start of the unread part.
    fn length_of_line_end(&mut self, at: usize) -> Result<usize, ReadError> {
        if self.block[self.unread.start + at] == b'\n' {
            return Ok(1);
        }
        let carriage_return_and_next = self.peek(at + 2)?;
        Ok(if carriage_return_and_next.get(at + 1) == Some(&b'\n') { 2 } else { 1 })
    }

    #[cold]
    fn read_exact_across_blocks(&mut self, mut target: &mut [u8]) -> io::Result<()> {
        while !target.is_empty() {
            match self.read(target)? {
                0 => return Err(io::ErrorKind::UnexpectedEof.into()),
                count => target = &mut target[count..],
            }
        }
        Ok(())
    }

    /// Reads once more behind the unread part, which may move within the block.
    fn read_more(&mut self) -> io::Result<usize> {
        if self.unread.start > 0 && self.unread.end == self.block.len() {
            self.block.copy_within(self.unread.clone(), 0);
            self.before += self.unread.start as u64;
            self.unread = 0..self.unread.len();
        }
        if self.unread.end == self.block.len() {
            let wanted = usize::try_from(self.size.saturating_add(1)).unwrap_or(usize::MAX);
            let more = self.block.len().max(BLOCK.min(wanted));
            self.block.resize(self.block.len() + more, 0);
        }
        loop {
            match self.source.read(&mut self.block[self.unread.end..]) {
                Ok(count) => {
                    self.unread.end += count;
                    return Ok(count);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}

impl Read for Input<'_> {
    fn read(&mut self, target: &mut [u8]) -> io::Result<usize> {
        let available = self.fill_buf()?;
        let count = available.len().min(target.len());
        target[..count].copy_from_slice(&available[..count]);
        self.consume(count);
        Ok(count)
    }

    /// Reads a number or two as quickly as from a slice; the crates above read nothing larger.
    #[inline]
    fn read_exact(&mut self, target: &mut [u8]) -> io::Result<()> {
        let end = self.unread.start + target.len();
        if end <= self.unread.end {
            target.copy_from_slice(&self.block[self.unread.start..end]);
            self.unread.start = end;
            return Ok(());
        }
        self.read_exact_across_blocks(target)
    }
}

impl BufRead for Input<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.unread.is_empty() {
            self.before += self.unread.start as u64;
            self.unread = 0..0;
            self.read_more()?;
        }
        Ok(&self.block[self.unread.clone()])
    }

    fn consume(&mut self, count: usize) {
        self.skip(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hands out one byte at a time, so that every line end falls on the edge of a block.
    struct Drop<'a>(&'a [u8]);

    impl Read for Drop<'_> {
        fn read(&mut self, target: &mut [u8]) -> io::Result<usize> {
            let count = self.0.len().min(target.len()).min(1);
            target[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    fn lines_of(text: &[u8]) -> Vec<(u64, String)> {
        let path = Path::new("x");
        let mut inputs = [
            Input::from_bytes(path, text, u64::MAX).unwrap(),
            Input::new(path, Box::new(Drop(text)), 1, 1).unwrap(),
        ];
        let [whole, dropwise] = inputs.each_mut().map(|input| {
            let mut lines = Vec::new();
            while let Some(line) = input.next_line().unwrap() {
                lines.push((line.number, String::from_utf8_lossy(line.text).into_owned()));
            }
            assert_eq!(input.position(), text.len() as u64);
            lines
        });
        assert_eq!(whole, dropwise);
        whole
    }

    #[test]
    fn lines_end_in_lf_crlf_or_cr() {
        let expected: Vec<_> = (1..).zip(["one", "", "three", "four"].map(str::to_owned)).collect();
        assert_eq!(lines_of(b"one\n\nthree\nfour"), expected);
        assert_eq!(lines_of(b"one\r\n\r\nthree\r\nfour\r\n"), expected);
        assert_eq!(lines_of(b"one\r\rthree\rfour\r"), expected);
        assert_eq!(lines_of(b"\n"), [(1, String::new())]);
    }

    #[test]
    fn a_line_may_be_longer_than_a_block() {
        let long = vec![b'x'; 3 * BLOCK + 7];
        let text = [&long[..], b"\nend"].concat();
        let mut input = Input::from_bytes(Path::new("x"), &text, u64::MAX).unwrap();
        assert_eq!(input.next_line().unwrap().unwrap().text.len(), long.len());
        assert_eq!(input.next_line().unwrap().unwrap().text, b"end");
        assert!(input.next_line().unwrap().is_none());
    }

    #[test]
    fn content_has_no_comments_and_no_blank_lines() {
        let text = b"# head\n\n  1 2 # tail\n\t\n3";
        let mut input = Input::from_bytes(Path::new("x"), text, u64::MAX).unwrap();
        let line = input.next_content().unwrap().unwrap();
        assert_eq!((line.text, line.number), (&b"1 2"[..], 3));
        assert_eq!(input.next_content().unwrap().unwrap().text, b"3");
        assert!(input.next_content().unwrap().is_none());
    }

    #[test]
    fn bytes_and_lines_can_be_read_in_turn() {
        let mut input = Input::from_bytes(Path::new("x"), b"\xef\xbb\xbfply\nABCD", 99).unwrap();
        input.skip_byte_order_mark().unwrap();
        assert_eq!(input.next_line().unwrap().unwrap().text, b"ply");
        assert_eq!(input.position(), 7);
        let mut rest = Vec::new();
        input.read_to_end(&mut rest).unwrap();
        assert_eq!(rest, b"ABCD");
        assert_eq!((input.position(), input.remaining()), (11, 0));
    }

    #[test]
    fn a_file_beyond_the_limit_is_not_read() {
        let error = Input::from_bytes(Path::new("x.off"), b"12345", 4).err().unwrap();
        assert_eq!(
            error.to_string(),
            "cannot read x.off: 5 bytes are more than the limit of 4; reduce or split the mesh"
        );
    }
}
