//! The bytes of a document, from sections 2 to 8 of `SPEC.md`.

use crate::part::{NOTHING, Part, Placement};

pub fn bytes(part: &Part) -> Vec<u8> {
    let mut file = File::new();
    let regions = part.tets.iter().map(|t| t.1).max().unwrap_or(1);
    let listed: Vec<String> = (1..=regions)
        .map(|id| format!(r#"{{"id":{id},"name":"round {id}"}}"#))
        .collect();
    file.chunk(b"REGN", format!("[{}]", listed.join(",")).into_bytes());
    if let Some([volume, area]) = part.source {
        let source = format!(
            r#"{{"format":"test","triangles":0,"volume":{volume:e},"boundary_area":{area:e},"precision":0}}"#
        );
        file.chunk(b"srce", source.into_bytes());
    }
    let coordinates = part.vertices.iter().flat_map(|p| p.to_array());
    file.chunk(b"VERT", coordinates.flat_map(f64::to_le_bytes).collect());
    let triangles = part.triangles.iter().flat_map(|f| {
        let [a, b, c] = f.vertices;
        [a, b, c, 0, f.front, f.back]
    });
    file.chunk(b"TRIS", words(triangles));
    let tets = part
        .tets
        .iter()
        .flat_map(|&([a, b, c, d], region)| [a, b, c, d, region]);
    file.chunk(b"TETS", words(tets));
    file.chunk(b"AXIS", words(part.axis.iter().copied()));
    for glue in &part.glues {
        let mut name = glue.name.as_bytes().to_vec();
        name.resize(name.len().next_multiple_of(4), 0);
        let [k, n, flags] = isometry(glue.step);
        let head = [
            0,
            k,
            n,
            flags,
            glue.name.len() as u32,
            glue.vertices.len() as u32,
            glue.triangles.len() as u32,
            0,
        ];
        let mut payload = words(head);
        payload.extend(name);
        payload.extend(words(glue.vertices.iter().flatten().copied()));
        payload.extend(words(glue.triangles.iter().flatten().copied()));
        file.chunk(b"GLUE", payload);
    }
    let instances = part.instances.iter().flat_map(|&placement| {
        let [k, n, flags] = isometry(placement);
        [0, k, n, flags, 0, 0]
    });
    file.chunk(b"INST", words(instances));
    file.end()
}

fn isometry(placement: Placement) -> [u32; 3] {
    let flags = u32::from(placement.mirrored) + 2 * u32::from(placement.flipped);
    assert!(placement.n < NOTHING);
    [placement.k, placement.n, flags]
}

fn words(all: impl IntoIterator<Item = u32>) -> Vec<u8> {
    all.into_iter().flat_map(u32::to_le_bytes).collect()
}

struct File {
    bytes: Vec<u8>,
    chunks: u64,
}

impl File {
    fn new() -> Self {
        let mut bytes = b"\x89TMESH\r\n".to_vec();
        bytes.extend([1, 0, 0, 0]);
        let checksum = crc32fast::hash(&bytes);
        bytes.extend(checksum.to_le_bytes());
        Self { bytes, chunks: 0 }
    }

    fn chunk(&mut self, id: &[u8; 4], payload: Vec<u8>) {
        let start = self.bytes.len();
        self.bytes.extend(id);
        self.bytes.extend([0; 4]);
        self.bytes.extend((payload.len() as u64).to_le_bytes());
        let checksum = crc32fast::hash(&self.bytes[start..]);
        self.bytes.extend(checksum.to_le_bytes());
        self.bytes.extend([0; 4]);
        let checksum = crc32fast::hash(&payload);
        self.bytes.extend(payload);
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        self.bytes.extend(checksum.to_le_bytes());
        self.bytes.extend([0; 4]);
        self.chunks += 1;
    }

    fn end(mut self) -> Vec<u8> {
        let counts = [self.chunks, self.bytes.len() as u64];
        self.chunk(b"END ", counts.map(u64::to_le_bytes).concat());
        self.bytes
    }
}
