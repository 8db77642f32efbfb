"""A poor channel: how it is written down, when messages arrive, and what a page sees of it."""

from __future__ import annotations

import asyncio
import math
import struct
import time
from dataclasses import replace
from random import Random

import numpy as np
import pytest
from contact_foundation.errors import InputError
from interactive_drive.channel.conditions import Conditions, parse_conditions
from interactive_drive.channel.direction import Direction
from interactive_drive.channel.timetable import Timetable
from served_drive import ServedDrive


class TestText:
    def test_all_of_it(self):
        conditions = parse_conditions("bandwidth=64kbit, delay=200ms,jitter=0.02s,loss=1%")
        assert conditions == Conditions(64e3, 0.2, 0.02, 0.01)
        assert str(conditions) == "64 kbit/s, 200 ms ± 20 ms each way, 1 % lost"

    def test_what_is_left_out_is_not_limited(self):
        assert parse_conditions("delay=1s") == Conditions(math.inf, 1.0, 0.0, 0.0)

    @pytest.mark.parametrize(
        ("text", "told"),
        [
            ("", "is nothing that a channel has"),
            ("bandwith=64kbit", "did you mean bandwidth?"),
            ("delay", "is nothing that a channel has"),
            ("delay=200", "no number with a unit of ms, s: '200'"),
            ("delay=-1ms", "no number"),
            ("delay=nans", "no number"),
            ("bandwidth=64KB", "no number with a unit of bit, kbit"),
            ("delay=1ms,delay=2ms", "delay is given twice"),
            ("bandwidth=0kbit", "1 kbit is the least"),
            ("delay=11s", "more than 10 s"),
            ("delay=10ms,jitter=11ms", "before they leave"),
            ("loss=91%", "more than 90 %"),
            ("loss=0.01", "unit of %"),
        ],
    )
    def test_what_is_wrong_is_told(self, text, told):
        with pytest.raises(InputError, match="--channel: ") as refused:
            parse_conditions(text)
        assert told in str(refused.value)
        assert "bandwidth=64kbit,delay=200ms" in str(refused.value)


class TestTimetable:
    def test_bytes_take_their_time_one_message_after_the_other(self):
        timetable = Timetable(Conditions(bandwidth=64e3, delay=0.2), Random(1))
        transits = [timetable.send(1.0, 800, reliable=False) for _ in range(3)]
        assert [t.left for t in transits] == pytest.approx([1.1, 1.2, 1.3])
        assert [t.arrives for t in transits] == pytest.approx([1.3, 1.4, 1.5])
        assert timetable.send(5.0, 0, reliable=True).left == 5.0

    def test_jitter_is_spread_evenly_around_the_delay(self):
        timetable = Timetable(Conditions(delay=0.2, jitter=0.02), Random(1))
        late = np.array([timetable.send(0.0, 100, reliable=False).arrives for _ in range(4000)]) - 0.2
        assert np.abs(late).max() <= 0.02
        assert late.mean() == pytest.approx(0.0, abs=4 * 0.02 / math.sqrt(3 * 4000))
        assert late.std() == pytest.approx(0.02 / math.sqrt(3), rel=0.05)

    def test_frames_are_lost_and_messages_come_later(self):
        timetable = Timetable(Conditions(delay=0.2, loss=0.1), Random(1))
        lost = sum(timetable.send(0.0, 1, reliable=False).arrives is None for _ in range(4000)) / 4000
        assert lost == pytest.approx(0.1, abs=4 * math.sqrt(0.1 * 0.9 / 4000))
        arrivals = [timetable.send(100.0 * k, 1, reliable=True).arrives - 100.0 * k for k in range(4000)]
        trips = np.round((np.array(arrivals) - 0.2) / 0.4)
        assert np.allclose(arrivals, 0.2 + 0.4 * trips, atol=1e-6)
        assert (trips > 0).mean() == pytest.approx(0.1, abs=4 * math.sqrt(0.1 * 0.9 / 4000))

    def test_messages_stay_in_order(self):
        timetable = Timetable(Conditions(delay=0.2, jitter=0.2, loss=0.3), Random(1))
        arrivals = [timetable.send(0.01 * k, 10, reliable=True).arrives for k in range(500)]
        assert arrivals == sorted(arrivals)


def test_a_direction_keeps_who_sends_as_long_as_the_bytes_take():
    async def use():
        arrived = []

        async def deliver(message):
            arrived.append((message, loop.time() - begin))

        direction = Direction(Conditions(bandwidth=80e3, delay=0.05), Random(1), deliver)
        loop = asyncio.get_running_loop()
        carrying = asyncio.create_task(direction.carry())
        begin = loop.time()
        for k in range(3):
            await direction.send(k, 100, reliable=True)
        assert loop.time() - begin >= 0.03 - 1e-3
        await asyncio.sleep(0.2)
        carrying.cancel()
        return arrived

    arrived = asyncio.run(use())
    assert [message for message, _ in arrived] == [0, 1, 2]
    assert all(when >= 0.01 * (k + 1) + 0.05 - 2e-3 for k, (_, when) in enumerate(arrived))


class TestPage:
    @pytest.fixture
    def drive(self, session):
        drive = ServedDrive(replace(session, channel=parse_conditions("bandwidth=32kbit,delay=100ms")))
        with drive.client:
            drive.log_in()
            yield drive

    def test_the_newest_frame_goes_and_none_waits(self, drive):
        with drive.page() as page:
            assert page.message("hello")["channel"] == "32 kbit/s, 100 ms each way"
            page.message("steering")
            until = time.monotonic() + 2.0
            ages, numbers = [], []

            def read():
                data = page.frame()
                heard, number = struct.unpack_from("<d", data, 16)[0], struct.unpack_from("<I", data, 28)[0]
                ages.append(time.time() - heard / 1e3)
                numbers.append(number)

            while time.monotonic() < until:
                for _ in range(20):
                    drive.frame()
                    time.sleep(0.005)
                read()
            # 20 frames of at least 56 bytes in 0.1 s do not fit into 400 bytes; what comes is new all the same.
            assert numbers == sorted(numbers)
            assert min(ages) > 0.1
            assert np.median(ages) < 1.0
            assert drive.numbers - numbers[-1] < 150

    def test_inputs_arrive_late_and_in_order(self, drive):
        with drive.page() as page:
            page.message("steering")
            begin = time.monotonic()
            for speed in (0.1, 0.5, 2.0):
                page.send(type="speed", value=speed)
            drive.wait_for_count(3)
            assert time.monotonic() - begin > 0.1
            assert [command.speed for command in drive.simulation.commands] == [0.1, 0.5, 2.0]

    def test_the_page_asks_for_the_servers_clock(self, drive):
        with drive.page() as page:
            page.send(type="clock", page=5.0)
            answer = page.message("clock")
            assert answer["page"] == 5.0
            assert abs(answer["server"] / 1e3 - time.time()) < 10
