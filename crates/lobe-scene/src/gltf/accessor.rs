//! Numbers out of the buffers of a glTF file, each access checked.

use super::Problem;
use gltf::accessor::{DataType, Dimensions, sparse::IndexType};
use gltf::{Accessor, buffer};

/// The bytes of all buffers of a file, in their order.
pub(super) type Buffers = Vec<Vec<u8>>;

/// The numbers of an accessor, `N` for each element. Integers that stand for fractions become them: −1 … 1 or 0 … 1.
pub(super) fn floats<const N: usize>(accessor: &Accessor<'_>, buffers: &Buffers) -> Result<Vec<[f32; N]>, Problem> {
    expect_components(accessor, N)?;
    let kind = accessor.data_type();
    let normalized = accessor.normalized();
    elements(accessor, buffers, N, |bytes| {
        let mut element = [0.0; N];
        for (to, part) in element.iter_mut().zip(bytes.chunks_exact(kind.size())) {
            *to = number(kind, part, normalized);
        }
        element
    })
}

/// The whole numbers of an accessor of one component.
pub(super) fn indices(accessor: &Accessor<'_>, buffers: &Buffers) -> Result<Vec<u32>, Problem> {
    expect_components(accessor, 1)?;
    let kind = accessor.data_type();
    if !matches!(kind, DataType::U8 | DataType::U16 | DataType::U32) {
        return Err(wrong(accessor, format!("holds {kind:?}, and indices are unsigned whole numbers")));
    }
    elements(accessor, buffers, 1, whole)
}

/// How many numbers an element of this kind has, if it is a scalar or a vector.
pub(super) fn components(dimensions: Dimensions) -> Option<usize> {
    match dimensions {
        Dimensions::Scalar => Some(1),
        Dimensions::Vec2 => Some(2),
        Dimensions::Vec3 => Some(3),
        Dimensions::Vec4 => Some(4),
        _ => None,
    }
}

fn expect_components(accessor: &Accessor<'_>, expected: usize) -> Result<(), Problem> {
    match components(accessor.dimensions()) {
        Some(found) if found == expected => Ok(()),
        _ => Err(wrong(
            accessor,
            format!("has elements of {:?} where {expected} numbers are read", accessor.dimensions()),
        )),
    }
}

fn wrong(accessor: &Accessor<'_>, what: impl std::fmt::Display) -> Problem {
    Problem(format!("accessor {} {what}", accessor.index()))
}

/// All elements, those of a sparse accessor put in their places.
fn elements<T: Copy>(
    accessor: &Accessor<'_>,
    buffers: &Buffers,
    components: usize,
    read: impl Fn(&[u8]) -> T,
) -> Result<Vec<T>, Problem> {
    let size = components * accessor.data_type().size();
    let count = accessor.count();
    let mut all = match accessor.view() {
        Some(view) => {
            let bytes = slice(&view, buffers).map_err(|problem| wrong(accessor, problem))?;
            let stride = view.stride().unwrap_or(size);
            if stride < size {
                return Err(wrong(accessor, format!("has elements of {size} bytes, {stride} bytes apart")));
            }
            let bytes = strided(bytes, accessor.offset(), stride, size, count);
            bytes
                .ok_or_else(|| {
                    wrong(accessor, format!("reaches past the end of its buffer view with {count} elements"))
                })?
                .map(&read)
                .collect()
        }
        // Zeros, of which a sparse one replaces some. Bounded, because no byte of the file stands for them.
        None => {
            const MOST: usize = 1 << 20;
            if accessor.sparse().is_none() {
                return Err(wrong(accessor, "has no buffer view; its data may be compressed, which is not supported"));
            }
            if count > MOST {
                return Err(wrong(accessor, format!("has {count} elements without data; at most {MOST} are taken")));
            }
            vec![read(&[0; 64][..size]); count]
        }
    };
    if let Some(sparse) = accessor.sparse() {
        let (indices, values) = (sparse.indices(), sparse.values());
        let width = match indices.index_type() {
            IndexType::U8 => 1,
            IndexType::U16 => 2,
            IndexType::U32 => 4,
        };
        let past =
            |what: &str| wrong(accessor, format!("has sparse {what} that reach past the end of their buffer view"));
        let places = slice(&indices.view(), buffers).map_err(|problem| wrong(accessor, problem))?;
        let places = strided(places, indices.offset(), width, width, sparse.count()).ok_or_else(|| past("indices"))?;
        let numbers = slice(&values.view(), buffers).map_err(|problem| wrong(accessor, problem))?;
        let numbers = strided(numbers, values.offset(), size, size, sparse.count()).ok_or_else(|| past("values"))?;
        for (place, number) in places.zip(numbers) {
            let place = whole(place) as usize;
            match all.get_mut(place) {
                Some(element) => *element = read(number),
                None => return Err(wrong(accessor, format!("has the sparse index {place}, and {count} elements"))),
            }
        }
    }
    Ok(all)
}

/// The bytes of a buffer view.
pub(super) fn slice<'b>(view: &buffer::View<'_>, buffers: &'b Buffers) -> Result<&'b [u8], String> {
    let (index, start, length) = (view.buffer().index(), view.offset(), view.length());
    let bytes = buffers.get(index).and_then(|bytes| bytes.get(start..start.checked_add(length)?));
    bytes.ok_or_else(|| {
        let found = buffers.get(index).map_or(0, Vec::len);
        format!("needs bytes {start} to {} of buffer {index}, which has {found}", start.saturating_add(length))
    })
}

/// `count` pieces of `size` bytes, `stride` apart; `None` if they are not all there.
fn strided(
    bytes: &[u8],
    offset: usize,
    stride: usize,
    size: usize,
    count: usize,
) -> Option<impl Iterator<Item = &[u8]>> {
    let bytes = bytes.get(offset..)?;
    let needed = match count.checked_sub(1) {
        Some(last) => last.checked_mul(stride)?.checked_add(size)?,
        None => 0,
    };
    let bytes = bytes.get(..needed)?;
    Some(bytes.chunks(stride).filter_map(move |piece| piece.get(..size)))
}

/// The little-endian number of up to four bytes.
fn whole(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |sum, byte| sum << 8 | u32::from(*byte))
}

/// One component. Normalised integers by the equations of glTF 2.0, section 3.11.
fn number(kind: DataType, bytes: &[u8], normalized: bool) -> f32 {
    let bits = whole(bytes);
    let (value, largest) = match kind {
        DataType::F32 => return f32::from_bits(bits),
        DataType::U32 => return bits as f32,
        DataType::I8 => (f32::from(bits as u8 as i8), 127.0),
        DataType::U8 => (f32::from(bits as u8), 255.0),
        DataType::I16 => (f32::from(bits as u16 as i16), 32767.0),
        DataType::U16 => (f32::from(bits as u16), 65535.0),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}
