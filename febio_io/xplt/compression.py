"""Zlib streams of unknown length: read forwards in small blocks until they end."""

import mmap
import zlib
from collections.abc import Iterator

FEED_SIZE = 1 << 18
BLOCK_SIZE = 1 << 18


def is_zlib_start(first: int, second: int) -> bool:
    """Whether two bytes can begin a zlib stream (RFC 1950, section 2.2)."""
    return first == 0x78 and ((first << 8) | second) % 31 == 0


class Inflater:
    """Reads one zlib stream from its start; holds no more than a block of it.

    Parameters
    ----------
    data : mmap or bytes
        The file.
    offset : int
        Where the stream starts.
    """

    def __init__(self, data: mmap.mmap | bytes, offset: int) -> None:
        self._data = data
        self._next = offset
        self._stream = zlib.decompressobj()
        self.inflated = 0

    @property
    def ended(self) -> bool:
        """Whether the stream's end has been reached."""
        return self._stream.eof

    @property
    def end(self) -> int:
        """Byte of the file after the stream, once it has ended."""
        return self._next - len(self._stream.unused_data)

    def read(self, count: int) -> bytes:
        """Inflate up to `count` bytes: fewer only where the stream, or the file, ends.

        Raises
        ------
        zlib.error
            If the bytes are no zlib stream.
        """
        return b"".join(self.pieces(count))

    def pieces(self, count: int) -> Iterator[bytes]:
        """Inflate up to `count` bytes, as :meth:`read` does, and give them piece by piece.

        Raises
        ------
        zlib.error
            If the bytes are no zlib stream.
        """
        wanted = count
        while wanted and not self._stream.eof:
            feed = self._stream.unconsumed_tail or self._feed()
            piece = self._stream.decompress(feed, wanted)
            if not feed and not piece:
                break
            wanted -= len(piece)
            self.inflated += len(piece)
            yield piece

    def skip(self, count: int) -> int:
        """Inflate and drop up to `count` bytes; return how many there were."""
        left = count
        while left:
            got = len(self.read(min(left, BLOCK_SIZE)))
            if not got:
                break
            left -= got
        return count - left

    def _feed(self) -> bytes:
        block = self._data[self._next : self._next + FEED_SIZE]
        self._next += len(block)
        return block
