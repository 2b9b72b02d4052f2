"""Zlib streams of unknown length: read forwards in small blocks until they end."""

import mmap
import zlib
from collections.abc import Iterator

FEED_SIZE = 1 << 18
BLOCK_SIZE = 1 << 18


# The two bytes of a zlib stream's header (RFC 1950, section 2.2).
ZLIB_FIRST = 0x78
ZLIB_SECOND = tuple(second for second in range(256) if (ZLIB_FIRST << 8 | second) % 31 == 0)


def is_zlib_start(first: int, second: int) -> bool:
    """Whether two bytes can begin a zlib stream."""
    return first == ZLIB_FIRST and second in ZLIB_SECOND


class WrongSizeError(Exception):
    """A zlib stream is not of the size it should be; the message says how."""


def inflate_exactly(packed: bytes, size: int) -> bytes:
    """Inflate a stream that must end with the bytes, and give so many.

    Raises
    ------
    zlib.error
        If the bytes are no zlib stream.
    WrongSizeError
        If the stream goes on, ends before the bytes do, or gives another number of bytes.
    """
    stream = zlib.decompressobj()
    content = stream.decompress(packed, size + 1)
    if len(content) != size:
        found = "more" if len(content) > size else str(len(content))
        raise WrongSizeError(f"{size} bytes expected, but {found} are there")
    if not stream.eof:
        stream.decompress(stream.unconsumed_tail, 1)  # takes in the checksum at the stream's end
    if not stream.eof:
        raise WrongSizeError("the compressed data is cut off where the next section begins")
    if stream.unused_data:
        raise WrongSizeError(
            f"{len(stream.unused_data)} bytes after the compressed data belong to no section"
        )
    return content


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
