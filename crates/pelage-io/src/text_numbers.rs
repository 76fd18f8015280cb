//! Numbers as text: the shortest that reads back as the same number, quickly.

/// Appends `value`. Infinities and NaN are spelled `inf`, `-inf` and `nan`, as USD
/// text does; formats without them must not be handed any.
pub(crate) fn push_f32(text: &mut Vec<u8>, value: f32) {
    if value.is_finite() {
        let mut buffer = ryu::Buffer::new();
        push_short(text, buffer.format_finite(value));
    } else {
        push_odd(text, f64::from(value));
    }
}

/// Appends `value`; see [`push_f32`].
pub(crate) fn push_f64(text: &mut Vec<u8>, value: f64) {
    if value.is_finite() {
        let mut buffer = ryu::Buffer::new();
        push_short(text, buffer.format_finite(value));
    } else {
        push_odd(text, value);
    }
}

/// Whole numbers need no `.0`.
fn push_short(text: &mut Vec<u8>, number: &str) {
    text.extend_from_slice(number.strip_suffix(".0").unwrap_or(number).as_bytes());
}

fn push_odd(text: &mut Vec<u8>, value: f64) {
    let name: &[u8] = match value {
        v if v.is_nan() => b"nan",
        v if v > 0.0 => b"inf",
        _ => b"-inf",
    };
    text.extend_from_slice(name);
}

/// Appends a whole number.
pub(crate) fn push_int(text: &mut Vec<u8>, value: impl itoa::Integer) {
    text.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn text(value: f32) -> String {
        let mut text = Vec::new();
        push_f32(&mut text, value);
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(text(1.0), "1");
        assert_eq!(text(-0.0), "-0");
        assert_eq!(text(0.1), "0.1");
        assert_eq!(text(f32::NAN), "nan");
        assert_eq!(text(f32::NEG_INFINITY), "-inf");
    }

    proptest! {
        #[test]
        fn text_reads_back_as_the_same_number(bits: u32) {
            let value = f32::from_bits(bits);
            prop_assume!(!value.is_nan());
            prop_assert_eq!(text(value).parse::<f32>().unwrap().to_bits(), bits);
        }
    }
}
