//! CDR as ROS 2 has it (OMG DDSI-RTPS 2.5, 10.2; little-endian, version 1): each number stands at a multiple of its own size, counted from behind the head of four bytes.

/// A message in the making.
pub(super) struct Cdr(Vec<u8>);

/// Little-endian, plain CDR.
const HEAD: [u8; 4] = [0, 1, 0, 0];

impl Cdr {
    pub(super) fn new() -> Self {
        Cdr(HEAD.to_vec())
    }

    pub(super) fn byte(&mut self, value: u8) {
        self.0.push(value);
    }

    pub(super) fn u16(&mut self, value: u16) {
        self.put(&value.to_le_bytes());
    }

    pub(super) fn u32(&mut self, value: u32) {
        self.put(&value.to_le_bytes());
    }

    pub(super) fn f64(&mut self, value: f64) {
        self.put(&value.to_le_bytes());
    }

    /// Numbers of an array whose length is known.
    pub(super) fn f64s<'a>(&mut self, values: impl IntoIterator<Item = &'a f64>) {
        values.into_iter().for_each(|value| self.f64(*value));
    }

    /// A text with its length and a zero at its end.
    pub(super) fn text(&mut self, text: &str) {
        self.u32(text.len() as u32 + 1);
        self.0.extend(text.as_bytes());
        self.byte(0);
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    fn put(&mut self, bytes: &[u8]) {
        let size = (self.0.len() - HEAD.len()).next_multiple_of(bytes.len()) + HEAD.len();
        self.0.resize(size, 0);
        self.0.extend(bytes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_at_multiples_of_their_size_behind_the_head() {
        let mut own = Cdr::new();
        own.text("ab");
        own.byte(7);
        own.f64(1.0);
        own.u16(0x0102);
        let expected: [&[u8]; 6] =
            [&HEAD, &[3, 0, 0, 0, b'a', b'b', 0], &[7], &1.0_f64.to_le_bytes(), &[2, 1], &[]];
        assert_eq!(own.into_bytes(), expected.concat());
    }
}
