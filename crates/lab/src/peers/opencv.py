"""One warp by OpenCV: opencv.py METHOD SIZE IN W H M0 ... M8 OUT

IN is SIZE x SIZE pixels of RGB8, OUT will be W x H of them. M maps the output to the source, pixel (i, j)
covering [i, i+1) x [j, j+1). METHOD is linear, cubic, or gaussian:N: a picture N times as large in each
direction, blurred by a Gaussian of half a pixel and decimated, which is the usual remedy; or mean:N, the
same with equal weights.
Prints the milliseconds of the warp alone, the second of two.

opencv.py mips SIZE prints those of a chain of halvings of SIZE x SIZE pixels of RGBA8 by INTER_AREA.
"""

import sys
import time

import cv2
import numpy as np

cv2.setNumThreads(1)


def between_centres(m):
    """OpenCV counts from the middle of the first pixel."""
    half = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, 1.0]])
    return np.linalg.inv(half) @ m @ half


def warped(image, m, size, flag):
    flags = flag | cv2.WARP_INVERSE_MAP
    return cv2.warpPerspective(image, between_centres(m), size, flags=flags, borderMode=cv2.BORDER_REPLICATE)


def supersampled(image, m, size, n):
    # One more row and column, and for an even n half a sample back: then sample n·i + ⌊n/2⌋ stands in
    # the middle of pixel i.
    back = -0.5 if n % 2 == 0 else 0.0
    fine = np.array([[1 / n, 0, back / n], [0, 1 / n, back / n], [0, 0, 1.0]])
    large = warped(image, m @ fine, (size[0] * n + 1, size[1] * n + 1), cv2.INTER_LINEAR)
    blurred = cv2.GaussianBlur(large, (0, 0), 0.5 * n, borderType=cv2.BORDER_REPLICATE)
    return np.ascontiguousarray(blurred[n // 2 :: n, n // 2 :: n][: size[1], : size[0]])


def averaged(image, m, size, n):
    fine = np.diag([1 / n, 1 / n, 1.0])
    large = warped(image, m @ fine, (size[0] * n, size[1] * n), cv2.INTER_LINEAR)
    return cv2.resize(large, size, interpolation=cv2.INTER_AREA)


def chain(image):
    side = image.shape[0]
    while side > 1:
        side //= 2
        image = cv2.resize(image, (side, side), interpolation=cv2.INTER_AREA)
    return image


def second_of_two(call):
    call()
    start = time.perf_counter()
    result = call()
    return (time.perf_counter() - start) * 1e3, result


def main(method, size, *rest):
    size = int(size)
    if method == "mips":
        image = np.arange(size * size * 4, dtype=np.uint32).astype(np.uint8).reshape(size, size, 4)
        print(second_of_two(lambda: chain(image))[0])
        return
    source, width, height, *m, out = rest
    image = np.fromfile(source, np.uint8).reshape(size, size, 3)
    m = np.array([float(v) for v in m]).reshape(3, 3)
    extent = (int(width), int(height))
    if method.startswith("gaussian:"):
        call = lambda: supersampled(image, m, extent, int(method.split(":")[1]))
    elif method.startswith("mean:"):
        call = lambda: averaged(image, m, extent, int(method.split(":")[1]))
    else:
        flag = {"linear": cv2.INTER_LINEAR, "cubic": cv2.INTER_CUBIC}[method]
        call = lambda: warped(image, m, extent, flag)
    ms, result = second_of_two(call)
    result.tofile(out)
    print(ms)


main(*sys.argv[1:])
