//! The states of alerts, and the commands of the bridge.

use insd_base::Span;
use insd_output::Boundary;
use insd_output::alerts::{AlertBoard, AlertConfig, Announcement, Condition, Escalation};
use insd_wire::nmea::{
    Acn, AlertCommand, AlertId, AlertPriority, AlertState, Alf, Arc, Hbt, Manufacturer,
};

use super::{acn, at};

use AlertCommand::{Acknowledge, Request, Silence, Transfer};
use AlertState::{Acknowledged, Normal, Rectified, Silenced, Transferred, Unacknowledged};
use Condition::{HeadingDegraded, HeadingLost, PositionLost, SystemFault};

/// What is done to an alert.
#[derive(Clone, Copy, Debug)]
enum Step {
    Raise,
    Rectify,
    Command(AlertCommand),
    Wait(f64),
}

use Step::{Command, Raise, Rectify, Wait};

fn everything(_: Condition) -> bool {
    true
}

fn beat(board: &mut AlertBoard, normal: bool, now: &Boundary) {
    board.hear(&Hbt { interval: Some(60.0), normal, sequence: None }, now.time);
}

/// A board to whose alert these steps were done, one a second, the bridge alive.
fn after(condition: Condition, steps: &[Step]) -> AlertBoard {
    let mut board = AlertBoard::default();
    let mut now = at(0.0);
    beat(&mut board, true, &now);
    for step in steps {
        match *step {
            Raise => board.raise(condition, &now),
            Rectify => board.rectify(condition, &now),
            Command(command) => assert_eq!(board.handle(&acn(condition, command), &now), None),
            Wait(seconds) => now = at(now.time.as_seconds() + seconds - 1.0),
        }
        now = at(now.time.as_seconds() + 1.0);
        board.wait(&now);
    }
    board
}

/// The newest that a board says of an alert.
fn told(board: &AlertBoard, condition: Condition) -> Alf {
    let is_it =
        |news: &Announcement| matches!(news, Announcement::Alert(own, _) if *own == condition);
    match board.news(0, everything).into_iter().find(is_it) {
        Some(Announcement::Alert(_, [title, _])) => title,
        _ => panic!("{condition:?} was never told of"),
    }
}

#[test]
fn a_warning_goes_from_state_to_state_as_the_diagram_has_it() {
    let (ack, silence, transfer) = (Command(Acknowledge), Command(Silence), Command(Transfer));
    let table: [(&[Step], AlertState); 16] = [
        (&[Raise], Unacknowledged),
        (&[Raise, Raise], Unacknowledged),
        (&[Raise, ack], Acknowledged),
        (&[Raise, ack, Raise], Acknowledged),
        (&[Raise, ack, Rectify], Normal),
        (&[Raise, silence], Silenced),
        (&[Raise, silence, ack], Acknowledged),
        (&[Raise, silence, Rectify], Rectified),
        (&[Raise, silence, transfer], Transferred),
        (&[Raise, transfer], Transferred),
        (&[Raise, transfer, ack], Acknowledged),
        (&[Raise, transfer, Rectify], Normal),
        (&[Raise, Rectify], Rectified),
        (&[Raise, Rectify, ack], Normal),
        (&[Raise, Rectify, Raise], Unacknowledged),
        (&[Rectify], Normal),
    ];
    for (steps, state) in table {
        assert_eq!(after(HeadingLost, steps).state(HeadingLost), state, "{steps:?}");
    }
}

#[test]
fn a_rectified_alert_that_nobody_acknowledged_stays_in_the_list_until_somebody_does() {
    let board = after(HeadingLost, &[Raise, Rectify]);
    assert_eq!(board.list(everything).len(), 1);
    assert_eq!(told(&board, HeadingLost).state, Some(Rectified));
    let board = after(HeadingLost, &[Raise, Rectify, Command(Acknowledge)]);
    assert_eq!(board.list(everything), []);
    assert_eq!(told(&board, HeadingLost).state, Some(Normal));
}

#[test]
fn silence_lasts_30_s_and_can_be_asked_for_again() {
    let silenced = [Raise, Command(Silence)];
    let state = |steps: &[Step]| after(HeadingLost, steps).state(HeadingLost);
    assert_eq!(state(&[&silenced[..], &[Wait(28.5)]].concat()), Silenced);
    assert_eq!(state(&[&silenced[..], &[Wait(29.0)]].concat()), Unacknowledged);
    let again = [&silenced[..], &[Wait(20.0), Command(Silence), Wait(20.0)]].concat();
    assert_eq!(state(&again), Silenced);
}

#[test]
fn a_warning_that_nobody_acknowledges_is_raised_again_every_5_min() {
    let board = after(HeadingLost, &[Raise, Wait(298.5)]);
    assert_eq!(
        (told(&board, HeadingLost).revision, told(&board, HeadingLost).escalation),
        (Some(1), Some(0))
    );
    let board = after(HeadingLost, &[Raise, Wait(299.0), Wait(300.0)]);
    let alf = told(&board, HeadingLost);
    assert_eq!((alf.revision, alf.escalation), (Some(3), Some(2)));
    assert_eq!((alf.state, alf.priority), (Some(Unacknowledged), Some(AlertPriority::Warning)));
    assert_eq!(alf.time.map(|time| (time.hour, time.minute)), Some((3, 14)));
}

#[test]
fn silence_does_not_put_it_off_and_what_is_acknowledged_is_not_raised_again() {
    let silenced = [Raise, Wait(290.0), Command(Silence), Wait(15.0)];
    assert_eq!(after(HeadingLost, &silenced).state(HeadingLost), Unacknowledged);
    for quiet in [Command(Acknowledge), Rectify] {
        let board = after(HeadingLost, &[Raise, quiet, Wait(1000.0)]);
        assert_eq!(told(&board, HeadingLost).revision, Some(2));
    }
}

#[test]
fn it_becomes_an_alarm_where_that_is_asked_for_and_is_a_warning_the_next_time() {
    let config = AlertConfig { patience: Span::from_seconds(60.0), escalation: Escalation::Alarm };
    let mut board = AlertBoard::new(config);
    board.raise(PositionLost, &at(0.0));
    for seconds in [60.0, 120.0, 180.0] {
        board.wait(&at(seconds));
        let alf = told(&board, PositionLost);
        assert_eq!((alf.priority, alf.escalation), (Some(AlertPriority::Alarm), Some(1)));
    }
    board.rectify(PositionLost, &at(200.0));
    board.raise(PositionLost, &at(201.0));
    let alf = told(&board, PositionLost);
    assert_eq!((alf.priority, alf.escalation), (Some(AlertPriority::Warning), Some(0)));
}

#[test]
fn escalations_are_counted_up_to_nine() {
    let again = [Wait(300.0); 12];
    let alf = told(&after(HeadingLost, &[&[Raise][..], &again].concat()), HeadingLost);
    assert_eq!((alf.escalation, alf.revision), (Some(9), Some(13)));
}

#[test]
fn a_caution_is_active_or_normal_and_needs_no_answer() {
    let mut board = after(HeadingDegraded, &[Raise, Wait(1000.0)]);
    assert_eq!(board.state(HeadingDegraded), Acknowledged);
    assert_eq!(told(&board, HeadingDegraded).revision, Some(1));
    beat(&mut board, true, &at(1000.0));
    for command in [Acknowledge, Silence, Transfer] {
        assert!(board.handle(&acn(HeadingDegraded, command), &at(1000.0)).is_some(), "{command:?}");
    }
    board.rectify(HeadingDegraded, &at(1001.0));
    assert_eq!(board.state(HeadingDegraded), Normal);
}

#[test]
fn responsibility_is_given_away_only_while_the_bridge_is_alive_and_comes_back() {
    let mut board = AlertBoard::default();
    board.raise(HeadingLost, &at(0.0));
    assert!(board.handle(&acn(HeadingLost, Transfer), &at(1.0)).is_some(), "no heartbeat");
    beat(&mut board, true, &at(2.0));
    assert_eq!(board.handle(&acn(HeadingLost, Transfer), &at(3.0)), None);
    board.wait(&at(152.0));
    assert_eq!(board.state(HeadingLost), Transferred, "2.5 intervals of a minute");
    board.wait(&at(152.1));
    assert_eq!(board.state(HeadingLost), Unacknowledged);

    beat(&mut board, true, &at(160.0));
    assert_eq!(board.handle(&acn(HeadingLost, Transfer), &at(160.0)), None);
    beat(&mut board, false, &at(161.0));
    board.wait(&at(161.0));
    assert_eq!(board.state(HeadingLost), Unacknowledged, "a bridge that has failed");
}

#[test]
fn an_acknowledged_alert_is_told_as_such() {
    let board = after(HeadingLost, &[Raise, Command(Acknowledge)]);
    let alf = told(&board, HeadingLost);
    assert_eq!((alf.state, alf.revision), (Some(Acknowledged), Some(2)));
    assert_eq!(board.list(everything)[0].revision, Some(2));
}

#[test]
fn a_command_about_an_unknown_alert_or_instance_is_refused() {
    let mut board = after(HeadingLost, &[Raise]);
    let alert = HeadingLost.alert();
    let strangers = [
        AlertId { identifier: 10_999, ..alert },
        AlertId { instance: Some(1), ..alert },
        AlertId { manufacturer: None, ..alert },
        AlertId { manufacturer: Manufacturer::new("FEC"), ..alert },
    ];
    for alert in strangers {
        for command in [Acknowledge, Request, Transfer, Silence] {
            let arc = board.handle(&Acn { time: None, alert, command }, &at(5.0)).unwrap();
            assert_eq!((arc.alert, arc.command), (alert, command));
            assert_eq!(arc.time.map(|time| (time.minute, time.second)), Some((4, 5)));
        }
    }
    assert_eq!(board.state(HeadingLost), Unacknowledged);
}

#[test]
fn a_command_that_a_state_has_no_arrow_for_is_refused() {
    let table: [(&[Step], &[AlertCommand]); 4] = [
        (&[], &[Acknowledge, Silence, Transfer, Request]),
        (&[Raise, Command(Acknowledge)], &[Acknowledge, Silence, Transfer]),
        (&[Raise, Command(Transfer)], &[Silence, Transfer]),
        (&[Raise, Rectify], &[Silence, Transfer]),
    ];
    for (steps, commands) in table {
        for command in commands {
            let mut board = after(HeadingLost, steps);
            let state = board.state(HeadingLost);
            let refusal = board.handle(&acn(HeadingLost, *command), &at(9.0));
            assert!(refusal.is_some(), "{steps:?} {command:?}");
            assert_eq!(board.state(HeadingLost), state);
        }
    }
}

#[test]
fn a_request_tells_an_alert_again_and_changes_nothing() {
    let mut board = after(HeadingLost, &[Raise]);
    let (before, stamp) = (told(&board, HeadingLost), board.stamp());
    assert_eq!(board.news(stamp, everything), []);
    assert_eq!(board.handle(&acn(HeadingLost, Request), &at(9.0)), None);
    let [Announcement::Alert(HeadingLost, [again, description])] =
        board.news(stamp, everything)[..]
    else {
        panic!("{:?}", board.news(stamp, everything))
    };
    assert_eq!(again, before);
    assert_eq!(description.text.to_string(), HeadingLost.description());
}

#[test]
fn news_come_in_the_order_in_which_they_came_up_each_alert_once() {
    let mut board = AlertBoard::default();
    board.raise(PositionLost, &at(0.0));
    board.raise(SystemFault, &at(0.0));
    let refused: Option<Arc> = board.handle(&acn(HeadingLost, Silence), &at(0.1));
    board.handle(&acn(PositionLost, Acknowledge), &at(0.2));
    let kinds: Vec<_> = board
        .news(0, everything)
        .into_iter()
        .map(|news| match news {
            Announcement::Alert(condition, [title, _]) => (Some(condition), title.state),
            Announcement::Refusal(_, arc) => {
                assert_eq!(Some(arc), refused);
                (None, None)
            }
        })
        .collect();
    let expected = [
        (Some(SystemFault), Some(Unacknowledged)),
        (None, None),
        (Some(PositionLost), Some(Acknowledged)),
    ];
    assert_eq!(kinds, expected);
}

#[test]
fn revisions_count_from_1_to_99_and_from_1_again() {
    let mut board = AlertBoard::default();
    let mut revisions = Vec::new();
    for _ in 0..60 {
        board.raise(HeadingDegraded, &at(0.0));
        revisions.push(told(&board, HeadingDegraded).revision.unwrap());
        board.rectify(HeadingDegraded, &at(0.0));
        revisions.push(told(&board, HeadingDegraded).revision.unwrap());
    }
    assert_eq!(revisions[..3], [1, 2, 3]);
    assert_eq!(revisions[97..101], [98, 99, 1, 2]);
}

#[test]
fn a_bridge_that_floods_us_is_refused_in_bounded_memory() {
    let mut board = AlertBoard::default();
    for _ in 0..1000 {
        board.handle(&acn(HeadingLost, Acknowledge), &at(0.0));
    }
    assert_eq!(board.news(0, everything).len(), 16);
}
