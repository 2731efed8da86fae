"""What a page sends as a picture, looked at before anything is made of it."""

import struct

SIGNATURE = b"\x89PNG\r\n\x1a\n"
HEADER, ANIMATION, CONTENT = b"IHDR", b"acTL", b"IDAT"


def is_single_png(content: bytes, largest_side: int) -> bool:
    """Whether it is a PNG file of one picture of no more pixels a side; few bytes can hold very many.

    Its chunks are read as section 5 of the PNG specification has them.
    """
    if not content.startswith(SIGNATURE) or content[12:16] != HEADER or len(content) < 33:
        return False
    if max(struct.unpack_from(">II", content, 16)) > largest_side:
        return False
    at = len(SIGNATURE)
    while at + 8 <= len(content):
        length, kind = struct.unpack_from(">I4s", content, at)
        if kind in (ANIMATION, CONTENT):
            return kind == CONTENT
        at += 12 + length
    return False
