//! Who is refused: other pages, other names, no token; and what comes in that is no photo.

use super::server::Server;
use serde_json::{Value, json};
use std::os::unix::fs::PermissionsExt;

#[test]
fn only_the_address_that_is_printed_opens_the_page_and_its_token_leaves_the_address_line() {
    let server = Server::new();
    let refused = server.call("GET", "/", &[], b"").is(403);
    assert!(
        refused
            .text()
            .contains("the address that the program printed"),
        "{}",
        refused.text()
    );
    assert_eq!(refused.header("set-cookie"), "");
    server
        .call("GET", "/?token=0123456789abcdef0123456789abcdef", &[], b"")
        .is(403);
    let entered = server
        .call("GET", &format!("/?token={}", server.token), &[], b"")
        .is(303);
    assert_eq!(entered.header("location"), "/");
    let cookie = entered.header("set-cookie");
    assert!(
        cookie.contains("HttpOnly") && cookie.contains("SameSite=Strict"),
        "{cookie}"
    );
    let cookie = cookie.split(';').next().unwrap();
    let page = server.call("GET", "/", &[("Cookie", cookie)], b"").is(200);
    assert!(!page.text().contains(&server.token));
    // Every other call asks for it as well.
    for path in tailor::serve::paths() {
        let path = path
            .replace("{id}", "0123456789abcdef")
            .replace(['{', '}'], "");
        server.call("GET", &path, &[], b"").is(403);
        server
            .call(
                "POST",
                &path,
                &[("Origin", &format!("http://127.0.0.1:{}", server.port))],
                b"",
            )
            .is(403);
    }
}

#[test]
fn other_pages_and_other_names_are_refused_though_the_browser_has_the_cookie() {
    let server = Server::new();
    let id = server.capture("anna");
    let cookie = format!("tailor-{}={}", server.port, server.token);
    let own = format!("http://127.0.0.1:{}", server.port);
    let ask = |more: &[(&str, &str)], method: &str, path: &str| {
        let headers: Vec<_> = more
            .iter()
            .copied()
            .chain([("Cookie", cookie.as_str())])
            .collect();
        server.call(method, path, &headers, b"")
    };
    let (page, stop) = (format!("/captures/{id}"), format!("/captures/{id}/stop"));
    ask(&[("Sec-Fetch-Site", "same-origin")], "GET", &page).is(200);
    ask(
        &[("Sec-Fetch-Site", "same-origin"), ("Origin", &own)],
        "POST",
        &stop,
    )
    .is(303);
    // A page of elsewhere: a form, a picture, a script.
    for site in ["cross-site", "same-site"] {
        ask(&[("Sec-Fetch-Site", site)], "GET", &page).is(403);
        ask(
            &[("Sec-Fetch-Site", site), ("Origin", "http://evil.example")],
            "POST",
            &stop,
        )
        .is(403);
    }
    for origin in [
        "http://evil.example",
        "null",
        "http://127.0.0.1:1",
        &own.replace("127.0.0.1", "localhost"),
    ] {
        ask(&[("Origin", origin)], "POST", &stop).is(403);
        ask(
            &[("Origin", origin)],
            "DELETE",
            &format!("/api/captures/{id}"),
        )
        .is(403);
    }
    ask(&[], "POST", &stop).is(403);
    // DNS rebinding: a name of elsewhere that leads here.
    for host in [
        format!("evil.example:{}", server.port),
        "127.0.0.1".to_owned(),
        String::new(),
    ] {
        ask(
            &[("Host", &host), ("Sec-Fetch-Site", "same-origin")],
            "GET",
            &page,
        )
        .is(403);
        let bearer = format!("Bearer {}", server.token);
        ask(
            &[("Host", &host), ("Authorization", &bearer)],
            "GET",
            "/api/captures",
        )
        .is(403);
    }
    let answer = server
        .ask("GET", "/api/captures", &Value::Null)
        .is(200)
        .json();
    assert_eq!(
        answer["captures"].as_array().unwrap().len(),
        1,
        "nothing was deleted"
    );
}

#[test]
fn an_address_that_another_page_opened_is_refused_with_what_to_do() {
    let server = Server::new();
    let own = format!("http://127.0.0.1:{}", server.port);
    let address = format!("/?token={}", server.token);
    for site in ["cross-site", "same-site"] {
        let refused = server.call("GET", &address, &[("Sec-Fetch-Site", site)], b"");
        let refused = refused.is(403);
        assert_eq!(refused.header("set-cookie"), "");
        let text = refused.text();
        assert!(text.contains("copy the address"), "{text}");
        assert!(
            text.contains("address bar") && !text.contains(&server.token),
            "{text}"
        );
    }
    // Forms and calls of other pages get the answers they got before.
    for (method, path) in [("POST", "/measure"), ("GET", "/api/captures")] {
        let headers = [("Sec-Fetch-Site", "cross-site"), ("Origin", own.as_str())];
        let text = server.call(method, path, &headers, b"").is(403).text();
        assert!(text.contains("Another page asked for this"), "{text}");
    }
}

#[test]
fn answers_order_the_browser_to_run_nothing_of_elsewhere() {
    let server = Server::new();
    let id = server.capture("anna");
    for path in [
        "/",
        "/nowhere",
        "/assets/page.css",
        "/api/captures",
        &format!("/captures/{id}"),
    ] {
        let answer = server.ask("GET", path, &Value::Null);
        let policy = answer.header("content-security-policy");
        assert!(
            policy.starts_with("default-src 'none'") && !policy.contains("unsafe"),
            "{path}: {policy}"
        );
        assert!(policy.contains("frame-ancestors 'none'") && policy.contains("form-action 'self'"));
        assert_eq!(answer.header("x-content-type-options"), "nosniff");
        let text = answer.text();
        assert!(
            !text.contains("://") || path.starts_with("/api"),
            "{path} names what is elsewhere"
        );
        assert!(
            !text.contains("style=\"") && !text.contains(" onclick"),
            "{path}"
        );
    }
}

#[test]
fn what_is_no_photo_is_refused_politely() {
    let server = Server::new();
    let id = server.capture("strange");
    let refused = |number: u32, name: &str, bytes: &[u8], status: u16, code: &str| {
        let answer = server.send(&id, number, name, bytes).is(status).json();
        assert_eq!(answer["code"], code, "{answer}");
    };
    refused(
        1,
        "a.jpg",
        b"<!doctype html><script>alert(1)</script>",
        415,
        "wrong-kind",
    );
    refused(1, "bomb.zip", b"PK\x03\x04bomb", 415, "wrong-kind");
    refused(
        1,
        "a.svg",
        b"<svg xmlns='http://www.w3.org/2000/svg'/>",
        415,
        "wrong-kind",
    );
    refused(1, "a.jpg", b"\xff\xd8\xff\xe0 torn", 422, "wrong-header");
    refused(
        1,
        "huge.png",
        include_bytes!("huge.png"),
        413,
        "wrong-pixels",
    );
    refused(0, "a.jpg", b"", 413, "wrong-many");
    refused(401, "a.jpg", b"", 413, "wrong-many");
    // 400 MB for one photo: read to the end of what was sent, and nothing is kept.
    let mut large = vec![0u8; 400 << 20];
    large[..3].copy_from_slice(b"\xff\xd8\xff");
    refused(1, "large.jpg", &large, 413, "wrong-large");
    let answer = server
        .ask("GET", &format!("/api/captures/{id}"), &Value::Null)
        .json();
    assert_eq!(answer["files"], json!({}));
    let left = |folder: &str| {
        std::fs::read_dir(server.path(&format!("captures/captures/{id}/{folder}")))
            .unwrap()
            .count()
    };
    assert_eq!((left("photos"), left("incoming")), (0, 0));
    // What a client sends as the length is not believed either.
    let bearer = format!("Authorization: Bearer {}\r\n", server.token);
    let head = format!(
        "PUT /api/captures/{id}/files/1 HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{bearer}Content-Length: 99999999999\r\nConnection: close\r\n\r\n",
        server.port
    );
    let mut socket = std::net::TcpStream::connect(("127.0.0.1", server.port)).unwrap();
    std::io::Write::write_all(&mut socket, head.as_bytes()).unwrap();
    socket.shutdown(std::net::Shutdown::Write).unwrap();
    let mut answer = String::new();
    std::io::Read::read_to_string(&mut socket, &mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 413"), "{answer}");
}

#[test]
fn names_are_shown_as_text_and_are_no_paths() {
    let server = Server::new();
    let id = server.capture("<img src=x onerror=alert(1)>");
    let photo = std::fs::read(&super::server::photos()[0]).unwrap();
    let name = "..%2f..%2f%3Cscript%3Ealert(1)%3C%2Fscript%3E.jpg";
    let kept = server.send(&id, 1, name, &photo).is(200).json();
    assert_eq!(
        (&kept["file"], &kept["name"]),
        (
            &json!("0001.jpg"),
            &json!("../../<script>alert(1)</script>.jpg")
        )
    );
    let page = server
        .ask("GET", &format!("/captures/{id}"), &Value::Null)
        .is(200)
        .text();
    assert!(
        !page.contains("<img src=x") && !page.contains("<script>alert"),
        "{page}"
    );
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;.jpg"));
    let file = server.path(&format!("captures/captures/{id}/photos/0001.jpg"));
    assert_eq!(
        std::fs::metadata(file).unwrap().permissions().mode() & 0o777,
        0o600
    );
    for path in [
        "/captures/../../../etc/passwd",
        "/captures/..%2f..%2fetc",
        "/api/captures/0123456789ABCDEF",
        &format!("/captures/{id}/out/..%2frecord.json"),
    ] {
        server.ask("GET", path, &Value::Null).is(404);
    }
}
