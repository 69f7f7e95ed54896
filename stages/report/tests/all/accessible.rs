//! The report for who hears it or sees little: nothing is wrong with it by axe-core, where `TAILOR_AXE` names its file.

use crate::chromium::Tab;
use crate::tube;
use report::{Html, HtmlParams};
use serde_json::json;
use stage::{Ctx, Stage};

#[test]
#[cfg_attr(not(chromium), ignore = "no Chromium is installed")]
fn axe_finds_nothing_in_any_window_light_or_dark() {
    let document = Html::run(&HtmlParams::default(), tube::input(), &Ctx::alone()).unwrap();
    let page = String::from_utf8(document.bytes).unwrap();
    for (width, phone) in [(390, true), (768, false), (1280, false)] {
        for dark in [false, true] {
            let mut tab = Tab::open(&page, [width, 900], phone, dark);
            assert_eq!(tab.axe(), json!([]), "{width} px, dark: {dark}");
            // The photos are reached by keys, and are named.
            let named =
                "document.querySelectorAll('figure svg[role=button][tabindex][aria-label]').length";
            assert!(tab.value(named).as_u64() > Some(0), "{width} px");
        }
    }
}
