//! The rules of nine-ball by constructed shots.

use carom_billiards::{BallInHand, Foul, MoveError, Rack, Shot, Stage, Verdict};

/// Makes a shot from what was hit first, what fell, and what met a cushion.
fn shot(first_hit: Option<u8>, pocketed: &[u8], railed: &[u8]) -> Shot {
    let mut shot = Shot::default();
    (shot.first_hit, shot.pocketed, shot.railed) = (first_hit, pocketed.into(), railed.into());
    shot
}

fn judged(rack: &mut Rack, shot: &Shot) -> Verdict {
    rack.judge(shot).unwrap()
}

/// Returns a rack of two players after a break that pocketed these balls; player 0 is at the table unless it is empty.
fn broken(pocketed: &[u8]) -> Rack {
    let mut rack = Rack::new(2, 0).unwrap();
    assert_eq!(judged(&mut rack, &shot(Some(1), pocketed, &[2, 3, 4, 5])).foul, None);
    rack
}

/// Returns a rack whose next shot is no longer the one after the break; player 0 is at the table.
fn open(pocketed: &[u8]) -> Rack {
    let mut rack = broken(pocketed);
    let lowest = rack.lowest();
    for _ in 0..1 + usize::from(rack.shooter() == 0) {
        judged(&mut rack, &shot(Some(lowest), &[], &[0]));
    }
    assert_eq!((rack.stage(), rack.shooter()), (Stage::Open, 0));
    rack
}

#[test]
fn a_break_pockets_a_ball_or_drives_four_to_cushions() {
    for (pocketed, railed, foul) in [
        (&[][..], &[2, 3, 4, 5][..], None),
        (&[], &[0, 2, 3, 4], Some(Foul::WeakBreak)),
        (&[7], &[], None),
    ] {
        let mut rack = Rack::new(2, 0).unwrap();
        assert_eq!(rack.in_hand(), BallInHand::BehindHeadString);
        let verdict = judged(&mut rack, &shot(Some(1), pocketed, railed));
        assert_eq!(verdict.foul, foul);
        assert_eq!(rack.shooter(), usize::from(pocketed.is_empty()));
        let stage = if foul.is_none() { Stage::AfterBreak } else { Stage::Open };
        assert_eq!(rack.stage(), stage);
        let in_hand = if foul.is_none() { BallInHand::No } else { BallInHand::Anywhere };
        assert_eq!(rack.in_hand(), in_hand);
    }
}

#[test]
fn the_lowest_ball_is_to_be_hit_first() {
    let mut rack = open(&[1, 3]);
    assert_eq!(rack.lowest(), 2);
    let foul = judged(&mut rack, &shot(Some(4), &[5], &[0])).foul;
    assert_eq!(foul, Some(Foul::WrongBall { hit: 4, lowest: 2 }));
    // The ball stays down, and the other player has the cue ball in hand.
    assert!(!rack.has(5));
    assert_eq!((rack.shooter(), rack.in_hand()), (1, BallInHand::Anywhere));
}

#[test]
fn a_shot_without_hit_or_cushion_is_a_foul_but_a_pocketed_ball_needs_no_cushion() {
    let of = |shot: &Shot| {
        let mut rack = open(&[]);
        let verdict = judged(&mut rack, shot);
        (verdict.foul, verdict.continues, rack.shooter())
    };
    assert_eq!(of(&shot(None, &[], &[])), (Some(Foul::NoHit), false, 1));
    assert_eq!(of(&shot(Some(1), &[], &[])), (Some(Foul::NoRail), false, 1));
    assert_eq!(of(&shot(Some(1), &[], &[0])), (None, false, 1));
    assert_eq!(of(&shot(Some(1), &[6], &[])), (None, true, 0));
}

#[test]
fn a_scratch_gives_ball_in_hand_and_the_cue_ball_comes_back() {
    let mut rack = open(&[]);
    let verdict = judged(&mut rack, &shot(Some(1), &[1, 0], &[]));
    assert_eq!((verdict.foul, verdict.continues), (Some(Foul::Scratch), false));
    assert!(rack.has(0) && !rack.has(1));
    let off = Shot { off_table: vec![0], ..shot(Some(2), &[], &[]) };
    assert_eq!(judged(&mut rack, &off).foul, Some(Foul::Scratch));
}

#[test]
fn the_nine_wins_at_any_time_but_on_a_foul_where_it_is_spotted() {
    let mut rack = Rack::new(2, 1).unwrap();
    assert_eq!(judged(&mut rack, &shot(Some(1), &[9], &[])).winner, Some(1));
    assert_eq!((rack.stage(), rack.winner()), (Stage::Won, Some(1)));
    assert_eq!(rack.judge(&shot(Some(1), &[], &[0])), Err(MoveError::Shot));
    // By a combination.
    assert_eq!(judged(&mut open(&[]), &shot(Some(1), &[9], &[])).winner, Some(0));
    for foul in [shot(Some(2), &[9], &[]), shot(Some(1), &[9, 0], &[])] {
        let mut rack = open(&[]);
        let verdict = judged(&mut rack, &foul);
        assert_eq!((verdict.winner, verdict.spots_nine, rack.has(9)), (None, true, true));
    }
    let off = Shot { off_table: vec![9, 4], ..shot(Some(1), &[], &[]) };
    let mut rack = open(&[]);
    let verdict = judged(&mut rack, &off);
    assert_eq!((verdict.foul, verdict.spots_nine), (Some(Foul::OffTable), true));
    // No other ball is spotted.
    assert!(rack.has(9) && !rack.has(4));
}

#[test]
fn a_push_out_needs_no_hit_and_the_other_player_chooses_who_shoots() {
    for shoots in [true, false] {
        let mut rack = broken(&[3]);
        rack.push_out().unwrap();
        let verdict = judged(&mut rack, &shot(None, &[9], &[]));
        assert_eq!((verdict.foul, verdict.winner, verdict.spots_nine), (None, None, true));
        assert_eq!((rack.stage(), rack.shooter()), (Stage::Answer, 1));
        assert_eq!(rack.judge(&shot(Some(1), &[], &[0])), Err(MoveError::Shot));
        rack.answer(shoots).unwrap();
        assert_eq!((rack.stage(), rack.shooter()), (Stage::Open, usize::from(shoots)));
        assert_eq!(rack.push_out(), Err(MoveError::PushOut));
        assert_eq!(rack.answer(true), Err(MoveError::Answer));
    }
    let mut rack = broken(&[]);
    rack.push_out().unwrap();
    assert_eq!(judged(&mut rack, &shot(None, &[0], &[])).foul, Some(Foul::Scratch));
    assert_eq!(rack.stage(), Stage::Open);
}

#[test]
fn three_fouls_of_a_player_in_a_row_lose_the_rack_and_a_good_shot_forgets_them() {
    let (good, miss) = (shot(Some(1), &[], &[0]), shot(None, &[], &[]));
    let mut rack = open(&[]);
    for _ in 0..2 {
        judged(&mut rack, &miss);
        judged(&mut rack, &good);
    }
    assert_eq!((rack.shooter(), rack.fouls_in_row(0)), (0, 2));
    let mut forgiven = rack.clone();
    judged(&mut forgiven, &good);
    assert_eq!(forgiven.fouls_in_row(0), 0);
    assert_eq!(judged(&mut rack, &miss).winner, Some(1));
}

#[test]
fn one_player_alone_goes_on_after_fouls_which_count_as_strokes() {
    let mut rack = Rack::new(1, 0).unwrap();
    for _ in 0..4 {
        assert_eq!(judged(&mut rack, &shot(None, &[], &[])).winner, None);
    }
    assert_eq!((rack.shooter(), rack.strokes()), (0, 8));
    assert_eq!(judged(&mut rack, &shot(Some(1), &[9], &[])).winner, Some(0));
    assert_eq!(rack.strokes(), 9);
}

#[test]
fn wrong_players_and_numbers_of_balls_do_no_harm() {
    for (players, breaker) in [(0, 0), (3, 0), (1, 1), (2, 2)] {
        assert_eq!(Rack::new(players, breaker), Err(MoveError::Players));
    }
    let mut rack = open(&[]);
    judged(&mut rack, &shot(Some(255), &[255, 10], &[254]));
    assert!(!rack.has(255) && rack.fouls_in_row(7) == 0);
}
