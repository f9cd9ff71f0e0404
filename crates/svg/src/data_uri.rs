//! Data URIs (RFC 2397): the bytes of an image inside an attribute.

/// The payload of a data URI; `None` if `href` is not one.
pub(crate) fn decode(href: &str, max_bytes: usize) -> Option<Result<Vec<u8>, DataUriError>> {
    let href = href.trim_start();
    let scheme = href.get(..5)?;
    if !scheme.eq_ignore_ascii_case("data:") {
        return None;
    }
    let rest = &href[5..];
    let Some((header, payload)) = rest.split_once(',') else {
        return Some(Err(DataUriError::Malformed("the data URI has no comma")));
    };
    let is_base64 = header.split(';').skip(1).any(|p| p.trim().eq_ignore_ascii_case("base64"));
    // Base64 has four characters for three bytes; percent-encoding never grows.
    let size = if is_base64 { payload.len() / 4 * 3 } else { payload.len() };
    if size > max_bytes {
        return Some(Err(DataUriError::TooLarge));
    }
    let bytes = percent_decode(payload);
    Some(if is_base64 { base64(bytes) } else { Ok(bytes.collect()) })
}

/// Why a data URI has no payload.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DataUriError {
    Malformed(&'static str),
    TooLarge,
}

/// The bytes of `text` with each `%xx` resolved; a `%` without two hex digits stands for itself.
fn percent_decode(text: &str) -> impl Iterator<Item = u8> + '_ {
    let mut rest = text.as_bytes();
    core::iter::from_fn(move || {
        let (&first, tail) = rest.split_first()?;
        rest = tail;
        if first == b'%'
            && let [high, low, after @ ..] = tail
            && let (Some(high), Some(low)) = (hex_digit(*high), hex_digit(*low))
        {
            rest = after;
            return Some(high << 4 | low);
        }
        Some(first)
    })
}

fn hex_digit(c: u8) -> Option<u8> {
    char::from(c).to_digit(16).and_then(|d| u8::try_from(d).ok())
}

/// Decodes base64 (RFC 4648 §4) leniently: white space is skipped, padding may be missing.
fn base64(text: impl Iterator<Item = u8>) -> Result<Vec<u8>, DataUriError> {
    let mut out = Vec::new();
    let (mut bits, mut held) = (0_u32, 0_u32);
    let mut padded = false;
    for c in text {
        let value = match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => {
                padded = true;
                continue;
            }
            b' ' | b'\t' | b'\r' | b'\n' => continue,
            _ => return Err(DataUriError::Malformed("a character is not base64")),
        };
        if padded {
            return Err(DataUriError::Malformed("base64 goes on after its padding"));
        }
        bits = bits << 6 | u32::from(value);
        held += 6;
        if held >= 8 {
            held -= 8;
            out.push((bits >> held & 0xff) as u8);
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ok(href: &str) -> Vec<u8> {
        decode(href, 1000).unwrap().unwrap()
    }

    #[test]
    fn payloads_in_every_spelling() {
        assert_eq!(ok("data:image/png;base64,aGVsbG8="), b"hello");
        assert_eq!(ok("data:image/png;base64,aGVs\n bG8"), b"hello");
        assert_eq!(ok("DATA:;charset=x;BASE64,aGVsbG8%3D"), b"hello");
        assert_eq!(ok("data:,a%20b%zz"), b"a b%zz");
        assert_eq!(ok("data:;base64,"), b"");
        for n in 0..20_usize {
            let bytes: Vec<u8> = (0..n).map(|i| (i * 37 + 200) as u8).collect();
            assert_eq!(ok(&format!("data:;base64,{}", encode(&bytes))), bytes);
        }
    }

    fn encode(bytes: &[u8]) -> String {
        const DIGITS: &[u8; 64] =
            b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut out = String::new();
        for chunk in bytes.chunks(3) {
            let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
            let bits = at(0) << 16 | at(1) << 8 | at(2);
            for k in 0..=chunk.len() {
                out.push(char::from(DIGITS[(bits >> (18 - 6 * k) & 63) as usize]));
            }
        }
        out
    }

    #[test]
    fn what_is_no_data_uri_and_what_is_a_bad_one() {
        assert_eq!(decode("img/a.png", 9), None);
        assert_eq!(decode("dat", 9), None);
        assert_eq!(decode("dätä:x", 9), None);
        assert!(matches!(decode("data:image/png", 9), Some(Err(DataUriError::Malformed(_)))));
        assert!(matches!(decode("data:;base64,a!b", 9), Some(Err(DataUriError::Malformed(_)))));
        assert!(matches!(decode("data:;base64,aa==aa", 9), Some(Err(DataUriError::Malformed(_)))));
        assert_eq!(decode("data:,0123456789", 9), Some(Err(DataUriError::TooLarge)));
    }
}
