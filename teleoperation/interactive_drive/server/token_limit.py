"""How often somebody may come with a wrong token."""

from __future__ import annotations

import ipaddress
import time
from collections import OrderedDict, deque
from collections.abc import Callable

MOST_WRONG = 5
PERIOD = 60.0
_MOST_CLIENTS = 1000
_IPV6_NETWORK = 64


class TokenLimit:
    """Notes wrong tokens by network address; five within a minute, and for the rest of it none is looked at.

    Args:
        clock: monotonic time, s.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._wrong: OrderedDict[str, deque[float]] = OrderedDict()

    def wait(self, client: str) -> float:
        """Seconds until a token of a client is looked at again; 0 if it is now."""
        times = self._wrong.get(_network(client))
        if times is None or len(times) < MOST_WRONG:
            return 0.0
        return max(0.0, times[0] + PERIOD - self._clock())

    def note(self, client: str) -> None:
        """A client came with a wrong one."""
        name = _network(client)
        times = self._wrong.setdefault(name, deque(maxlen=MOST_WRONG))
        times.append(self._clock())
        self._wrong.move_to_end(name)
        while len(self._wrong) > _MOST_CLIENTS:
            self._wrong.popitem(last=False)


def _network(client: str) -> str:
    """An address, and of IPv6 the network that one customer has."""
    try:
        address = ipaddress.ip_address(client.partition("%")[0])
    except ValueError:
        return client
    if isinstance(address, ipaddress.IPv6Address) and address.ipv4_mapped is None:
        return str(ipaddress.ip_network((address, _IPV6_NETWORK), strict=False))
    return str(address)
