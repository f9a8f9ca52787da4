//! What the desk promises: the newest wish of each place, one job at a time, and a turn for everyone.

use fairpath_curve::{Point, Segment, Spline};
use fairpath_shape::InflateOptions;
use fairpath_sketch::{CurveId, Desk, Job, Slot, Ticket, Wish};
use proptest::prelude::*;
use std::collections::BTreeMap;

const SLOTS: [Slot; 6] = [
    Slot::Live,
    Slot::Preview,
    Slot::Curve(CurveId(1)),
    Slot::Curve(CurveId(2)),
    Slot::Oversketch(CurveId(1)),
    Slot::Surface(CurveId(1)),
];

/// A job that can be told from the others by a number.
fn job(number: u32) -> Job {
    let line = Segment::line(Point::ORIGIN, 0.0, f64::from(number) + 1.0);
    let spline = Spline::new(vec![line], Vec::new(), false).unwrap();
    Job::Inflate { spline, options: InflateOptions::default() }
}

#[derive(Clone, Copy, Debug)]
enum Act {
    Want(usize),
    WantAlso(usize),
    Drop(usize),
    Clear,
    Next,
    Done,
    DoneWithSomethingElse(u64),
}

fn act() -> impl Strategy<Value = Act> {
    let slot = 0..SLOTS.len();
    prop_oneof![
        3 => slot.clone().prop_map(Act::Want),
        3 => slot.clone().prop_map(Act::WantAlso),
        2 => slot.prop_map(Act::Drop),
        1 => Just(Act::Clear),
        4 => Just(Act::Next),
        3 => Just(Act::Done),
        1 => (0_u64..40).prop_map(Act::DoneWithSomethingElse),
    ]
}

proptest! {
    #[test]
    fn the_newest_wish_of_each_place_is_done_one_at_a_time_and_answers_to_dropped_ones_go_nowhere(
        acts in prop::collection::vec(act(), 1..80)
    ) {
        let mut desk = Desk::default();
        // What waits for each place, and what is under way: ticket, place, whether it is still wanted.
        let mut waiting: BTreeMap<usize, u32> = BTreeMap::new();
        let mut under_way: Option<(Ticket, usize, bool)> = None;
        for (number, act) in (0_u32..).zip(acts) {
            match act {
                Act::Want(slot) | Act::WantAlso(slot) => {
                    let wish = Wish::new(SLOTS[slot], None);
                    if let Act::Want(_) = act {
                        desk.want(wish, job(number));
                        under_way = under_way.map(|(t, s, wanted)| (t, s, wanted && s != slot));
                    } else {
                        desk.want_also(wish, job(number));
                    }
                    waiting.insert(slot, number);
                }
                Act::Drop(slot) => {
                    desk.drop_wishes(SLOTS[slot]);
                    waiting.remove(&slot);
                    under_way = under_way.map(|(t, s, wanted)| (t, s, wanted && s != slot));
                }
                Act::Clear => {
                    desk.clear();
                    waiting.clear();
                    under_way = under_way.map(|(t, s, _)| (t, s, false));
                }
                Act::Next => match desk.next_job() {
                    Some((ticket, given)) => {
                        prop_assert!(under_way.is_none(), "two jobs are under way");
                        let found = waiting.iter().find(|(_, number)| job(**number) == given);
                        let (&slot, _) = found.expect("the job is the newest wish of a place");
                        waiting.remove(&slot);
                        under_way = Some((ticket, slot, true));
                    }
                    None => prop_assert!(under_way.is_some() || waiting.is_empty(), "a free worker gets nothing"),
                },
                Act::Done => {
                    if let Some((ticket, slot, wanted)) = under_way.take() {
                        let got = desk.done(ticket).map(|wish| wish.slot);
                        prop_assert_eq!(got, wanted.then_some(SLOTS[slot]));
                    }
                }
                Act::DoneWithSomethingElse(number) => {
                    let ticket = Ticket(number);
                    if under_way.is_none_or(|(busy, _, _)| busy != ticket) {
                        prop_assert!(desk.done(ticket).is_none());
                    }
                }
            }
            prop_assert_eq!(desk.is_idle(), waiting.is_empty() && under_way.is_none());
        }
    }

    /// Every place asks anew before each job, as places do while a slider moves or a stroke grows.
    #[test]
    fn no_place_starves_while_all_ask_again_and_again(order in Just((0..SLOTS.len()).collect::<Vec<_>>()).prop_shuffle()) {
        let mut desk = Desk::default();
        let mut last_served = [0_usize; SLOTS.len()];
        for turn in 1..200 {
            for &slot in &order {
                desk.want_also(Wish::new(SLOTS[slot], None), job(slot as u32));
            }
            let (ticket, _) = desk.next_job().expect("there is work");
            let wish = desk.done(ticket).expect("it is wanted");
            let slot = SLOTS.iter().position(|&slot| slot == wish.slot).unwrap();
            last_served[slot] = turn;
            for (slot, &served) in last_served.iter().enumerate() {
                prop_assert!(turn - served <= 5 * SLOTS.len(), "{:?} waits since {served}, it is {turn}", SLOTS[slot]);
            }
        }
    }
}

#[test]
fn the_stroke_in_hand_comes_first() {
    let mut desk = Desk::default();
    desk.want(Wish::new(SLOTS[2], None), job(1));
    desk.want(Wish::new(Slot::Live, None), job(2));
    let (ticket, first) = desk.next_job().unwrap();
    assert_eq!(first, job(2));
    assert!(desk.next_job().is_none());
    assert_eq!(desk.done(ticket).map(|wish| wish.slot), Some(Slot::Live));
    assert_eq!(desk.next_job().map(|(_, job)| job), Some(job(1)));
}
