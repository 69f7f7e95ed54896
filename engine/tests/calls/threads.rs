//! Where the system gives no thread, nothing hangs and nothing panics.

use crate::place::Place;
use crate::traced::Fault;

#[test]
fn where_the_system_gives_no_thread_a_sweep_is_whole_and_a_bucket_an_error() {
    let place = Place::new();
    std::fs::create_dir(place.at("store")).unwrap();
    place.sound("run WORDS --input IN=OTHER --quiet --store STORE");
    place.all_waits();
    place.is_base();
    let rows = [Fault::None, Fault::NoThreads].map(|fault| {
        place.begin();
        let line = "sweep WORDS --sweep counts.least_letters=1,4,5 --input IN=OTHER --out OUT";
        let ended = place.asked(line, fault);
        assert_eq!(ended.code, Some(0), "{ended:?}");
        assert_eq!(ended.call.is_some(), fault == Fault::NoThreads);
        let table = std::fs::read_to_string(place.at("out/sweep.csv")).unwrap();
        table.lines().count()
    });
    assert_eq!(rows, [4; 2]);
    place.begin();
    let line = "cache push --store s3://nobody/here --store-wait 1";
    let ended = place.asked(line, Fault::NoThreads);
    let why = "the system gives no thread";
    assert!(
        ended.code == Some(2) && ended.errors.contains(why),
        "{ended:?}"
    );
}
