//! Checks of an accessor: the `gltf` crate reads it, and trusts that these things hold.

use gltf::accessor::sparse::{IndexType, Sparse};
use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::buffer::View;

use super::buffer::Buffers;
use super::malformed;
use crate::error::ReadError;

/// Values that an accessor may have without data behind them, in the file or in its buffers.
const VALUES_FROM_NOTHING: u64 = 65_536;

/// Loads the buffers of an accessor and checks that all its values lie in them.
pub(super) fn check(accessor: &Accessor<'_>, buffers: &mut Buffers<'_>) -> Result<(), ReadError> {
    let part = format!("accessors[{}]", accessor.index());
    let (count, size) = (accessor.count(), accessor.size());
    if count == 0 {
        return Err(malformed(buffers.path(), part, "a count of at least 1", "0"));
    }
    if let Some(view) = accessor.view() {
        check_range(&part, &view, accessor.offset(), count, size, buffers)?;
    }
    if let Some(sparse) = accessor.sparse() {
        check_sparse(&part, &sparse, count, size, buffers)?;
    }
    // Zeros need no data, so that a count alone could ask for any amount of memory.
    if accessor.view().is_none() && count as u64 > VALUES_FROM_NOTHING + buffers.size() {
        let expected = "fewer values than the buffers have bytes, as these have no data";
        return Err(malformed(buffers.path(), part, expected, count.to_string()));
    }
    Ok(())
}

/// Checks the type of an accessor.
pub(super) fn check_type(
    accessor: &Accessor<'_>,
    buffers: &Buffers<'_>,
    expected: &str,
    allowed: impl Fn(DataType, Dimensions) -> bool,
) -> Result<(), ReadError> {
    let (data, dimensions) = (accessor.data_type(), accessor.dimensions());
    if allowed(data, dimensions) {
        return Ok(());
    }
    let part = format!("accessors[{}]", accessor.index());
    let found = format!("{dimensions:?} of {data:?}");
    Err(malformed(buffers.path(), part, expected, found))
}

fn check_sparse(
    part: &str,
    sparse: &Sparse<'_>,
    count: usize,
    size: usize,
    buffers: &mut Buffers<'_>,
) -> Result<(), ReadError> {
    let part = format!("{part}.sparse");
    let (indices, values) = (sparse.indices(), sparse.values());
    if sparse.count() == 0 || sparse.count() > count {
        let expected = format!("a count from 1 to {count}");
        return Err(malformed(buffers.path(), part, expected, sparse.count().to_string()));
    }
    let index_size = indices.index_type().size();
    let (view, offset) = (indices.view(), indices.offset());
    check_range(&part, &view, offset, sparse.count(), index_size, buffers)?;
    check_range(&part, &values.view(), values.offset(), sparse.count(), size, buffers)?;

    // Both ranges are inside of their buffers, so that nothing is skipped here.
    let stride = view.stride().unwrap_or(index_size);
    let bytes = buffers.get(view.buffer().index()).unwrap_or_default();
    let bytes = bytes.get(view.offset() + offset..).unwrap_or_default();
    let mut next = 0;
    for index in bytes
        .chunks(stride)
        .take(sparse.count())
        .filter_map(|chunk| little_endian(chunk.get(..index_size)?, indices.index_type()))
    {
        if index < next || index >= count as u64 {
            let expected = format!("increasing indices below {count}");
            return Err(malformed(buffers.path(), part, expected, index.to_string()));
        }
        next = index + 1;
    }
    Ok(())
}

fn little_endian(bytes: &[u8], kind: IndexType) -> Option<u64> {
    Some(match kind {
        IndexType::U8 => u64::from(*bytes.first()?),
        IndexType::U16 => u64::from(u16::from_le_bytes(bytes.try_into().ok()?)),
        IndexType::U32 => u64::from(u32::from_le_bytes(bytes.try_into().ok()?)),
    })
}

/// Checks that `count` values of `size` bytes lie in a view, and the view in its buffer.
fn check_range(
    part: &str,
    view: &View<'_>,
    offset: usize,
    count: usize,
    size: usize,
    buffers: &mut Buffers<'_>,
) -> Result<(), ReadError> {
    buffers.load(&view.buffer())?;
    let path = buffers.path();
    let view_part = format!("bufferViews[{}]", view.index());
    let available = buffers.get(view.buffer().index()).map_or(0, <[u8]>::len);
    if view.offset().checked_add(view.length()).is_none_or(|end| end > available) {
        let expected = format!("a part of the {available} bytes of its buffer");
        let found = format!("{} bytes from byte {}", view.length(), view.offset());
        return Err(malformed(path, view_part, expected, found));
    }
    let stride = view.stride().unwrap_or(size);
    if stride < size {
        let expected = format!("a stride of at least {size} bytes");
        return Err(malformed(path, view_part, expected, stride.to_string()));
    }
    let end = (count - 1)
        .checked_mul(stride)
        .and_then(|start_of_last| start_of_last.checked_add(offset)?.checked_add(size));
    if end.is_none_or(|end| end > view.length()) {
        let expected = format!("values within the {} bytes of {view_part}", view.length());
        let found = format!("{count} of them, one every {stride} bytes from byte {offset}");
        return Err(malformed(path, part, expected, found));
    }
    Ok(())
}
