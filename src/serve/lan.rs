//! The address in the local network, and a picture of it for a phone's camera.

use maud::{Markup, PreEscaped};
use qrcodegen::{QrCode, QrCodeEcc};
use std::fmt::Write as _;
use std::net::{IpAddr, UdpSocket};

/// The address under which other machines of the local network reach this machine.
///
/// # Errors
///
/// There is no network.
pub(super) fn address() -> std::io::Result<IpAddr> {
    let socket = UdpSocket::bind("0.0.0.0:0")?;
    // Sends nothing: asks which way there is to an address that nobody has (RFC 5737).
    socket.connect("192.0.2.1:9")?;
    let address = socket.local_addr()?.ip();
    match address.is_loopback() || address.is_unspecified() {
        true => Err(std::io::Error::other("no network is connected")),
        false => Ok(address),
    }
}

/// Free modules around the code, as the standard wants.
const QUIET: i32 = 4;

fn code(url: &str) -> QrCode {
    QrCode::encode_text(url, QrCodeEcc::Medium).expect("bug: an address fits a QR code")
}

/// The code as a drawing.
pub(super) fn drawing(url: &str) -> Markup {
    let code = code(url);
    let size = code.size() + 2 * QUIET;
    let mut path = String::new();
    for (x, y) in dark(&code) {
        let _ = write!(path, "M{},{}h1v1h-1z", x + QUIET, y + QUIET);
    }
    PreEscaped(format!(
        "<svg class=\"qr\" viewBox=\"0 0 {size} {size}\" aria-hidden=\"true\">\
         <rect width=\"{size}\" height=\"{size}\" fill=\"#fff\"/><path d=\"{path}\" fill=\"#000\"/></svg>"
    ))
}

fn dark(code: &QrCode) -> Vec<(i32, i32)> {
    let all = (0..code.size()).flat_map(|y| (0..code.size()).map(move |x| (x, y)));
    all.filter(|(x, y)| code.get_module(*x, *y)).collect()
}

/// The code for a terminal: two modules a letter.
pub(super) fn letters(url: &str) -> String {
    let code = code(url);
    let mut text = String::new();
    for y in (-QUIET..code.size() + QUIET).step_by(2) {
        for x in -QUIET..code.size() + QUIET {
            // Light on dark, as most terminals are: light modules are drawn.
            let light = |y: i32| !code.get_module(x, y);
            text.push(match (light(y), light(y + 1)) {
                (true, true) => '█',
                (true, false) => '▀',
                (false, true) => '▄',
                (false, false) => ' ',
            });
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drawing_has_every_dark_module_and_a_quiet_zone() {
        let url = "http://192.168.1.20:7007/?token=0123456789abcdef0123456789abcdef";
        let (code, svg) = (code(url), drawing(url).into_string());
        assert_eq!(svg.matches('M').count(), dark(&code).len());
        assert!(svg.contains(&format!("viewBox=\"0 0 {0} {0}\"", code.size() + 8)));
        let letters = letters(url);
        let first = letters.lines().next().unwrap();
        assert!(first.chars().all(|c| c == '█'), "{first}");
        assert_eq!(first.chars().count() as i32, code.size() + 8);
    }
}
