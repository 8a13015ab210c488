//! Files to send: a header, then the content in pieces.

use crate::app::model::Export;
use crate::grpc::proto;
use proto::file_chunk::Part;

/// Maximum size of one piece, bytes: far below the message size that clients accept.
const PIECE_BYTES: usize = 256 << 10;

/// The messages of a file.
pub fn chunks(file: Export) -> Vec<proto::FileChunk> {
    let Export { content_type, file_name, bytes } = file;
    let header = proto::FileHeader { content_type: content_type.to_owned(), file_name };
    let pieces = bytes.chunks(PIECE_BYTES).map(|piece| Part::Content(piece.to_vec()));
    let parts = std::iter::once(Part::Header(header)).chain(pieces);
    parts.map(|part| proto::FileChunk { part: Some(part) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_comes_first_and_the_pieces_are_the_file() {
        for length in [0, 1, PIECE_BYTES, PIECE_BYTES + 1] {
            let bytes: Vec<u8> = (0..length).map(|i| u8::try_from(i % 251).unwrap()).collect();
            let mut parts = chunks(Export::new("text/csv", "wax", "csv", bytes.clone())).into_iter();
            let first = parts.next().and_then(|chunk| chunk.part);
            let Some(Part::Header(header)) = first else { panic!("{first:?} comes before the header") };
            assert_eq!((header.content_type.as_str(), header.file_name.as_str()), ("text/csv", "wax.csv"));
            let mut received = Vec::new();
            for chunk in parts {
                let Some(Part::Content(piece)) = chunk.part else { panic!("a second header") };
                assert!(!piece.is_empty() && piece.len() <= PIECE_BYTES);
                received.extend(piece);
            }
            assert_eq!(received, bytes);
        }
    }
}
