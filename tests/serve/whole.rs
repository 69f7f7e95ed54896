//! A page as a whole, in every window: nothing is wrong with it for who hears it or sees little. With
//! `TAILOR_SHOTS=FOLDER` pictures are kept there; with `TAILOR_AXE=axe.min.js` axe-core looks, too.

use super::chromium::Tab;
use super::server::Server;
use serde_json::{Value, json};

const DESK: [u32; 2] = [1280, 900];
/// Widths, and whether it is a phone. \[px\]
const WINDOWS: [([u32; 2], bool); 4] = [
    ([360, 740], true),
    ([390, 844], true),
    ([768, 1024], false),
    ([1280, 900], false),
];

pub(crate) fn tab(language: &str) -> Tab {
    let mut tab = Tab::empty(DESK, false, false);
    let headers = json!({ "headers": { "Accept-Language": language } });
    tab.ask("Network.setExtraHTTPHeaders", headers);
    tab
}

/// Nothing is wrong with the page for who hears it or sees little, in no window, light or dark.
#[track_caller]
pub(crate) fn whole(tab: &mut Tab, name: &str) {
    for (size, phone) in WINDOWS.into_iter().chain([([3840, 2160], false)]) {
        for dark in [false, true] {
            tab.emulate(size, phone, dark);
            tab.drawn();
            let wrong = tab.value(include_str!("accessible.js"));
            assert_eq!(wrong, json!([]), "{name} at {size:?}, dark: {dark}");
            assert_eq!(tab.axe(), json!([]), "{name} at {size:?}, dark: {dark}");
            keep(
                tab,
                &format!("{name}-{}{}", size[0], if dark { "-dark" } else { "" }),
            );
        }
    }
    tab.emulate(DESK, false, false);
    tab.drawn();
}

/// Keeps what the page shows, if somebody wants it.
fn keep(tab: &mut Tab, name: &str) {
    let params = json!({ "format": "png", "captureBeyondViewport": true });
    kept(tab, params, &format!("{name}.png"));
}

/// A picture for the book: the window at a desk, once its pictures are there.
pub(crate) fn picture(server: &Server, path: &str, name: &str) {
    if std::env::var_os("TAILOR_SHOTS").is_none() {
        return;
    }
    let mut tab = tab("en");
    tab.go(&server.url());
    tab.go(&format!("{}{path}", server.origin()));
    tab.until("[...document.images].every((i) => i.complete || i.getBoundingClientRect().top > innerHeight)");
    std::thread::sleep(std::time::Duration::from_millis(500));
    let params = json!({ "format": "jpeg", "quality": 65 });
    kept(&mut tab, params, &format!("{name}.jpg"));
}

fn kept(tab: &mut Tab, params: Value, name: &str) {
    let Some(folder) = std::env::var_os("TAILOR_SHOTS") else {
        return;
    };
    let shot = tab.ask("Page.captureScreenshot", params);
    let bytes = base64_decoded(shot["data"].as_str().unwrap());
    std::fs::write(std::path::Path::new(&folder).join(name), bytes).unwrap();
}

fn base64_decoded(text: &str) -> Vec<u8> {
    use base64::Engine;
    base64::engine::general_purpose::STANDARD
        .decode(text)
        .unwrap()
}

/// What the browser complained of, and what it asked of elsewhere.
pub(crate) fn complaints(tab: &mut Tab, server: &Server) -> Vec<String> {
    let own = format!("{}/", server.origin());
    let one = |event: &Value| {
        let params = &event["params"];
        match event["method"].as_str()? {
            "Log.entryAdded" => Some(params["entry"]["text"].to_string()),
            "Runtime.exceptionThrown" => Some(params["exceptionDetails"].to_string()),
            "Network.requestWillBeSent" => {
                let url = params["request"]["url"].as_str()?;
                let strange = !url.starts_with(&own)
                    && !url.starts_with("data:")
                    && !url.starts_with("blob:");
                strange.then(|| url.to_owned())
            }
            _ => None,
        }
    };
    tab.events.iter().filter_map(one).collect()
}
