"""Flow in a weakly curved tube that no longer changes along it: the equations of Dean, Phil. Mag. 5 (1928) 673-695, solved numerically."""

from __future__ import annotations

import numpy as np

#: Points over the diameter less one (odd, so that none is on the axis), and around it: at a Dean number of 100 the friction is right to six digits.
N, M = 25, 28


class Disc:
    """Chebyshev points over the diameter, Fourier around: Trefethen, Spectral Methods in MATLAB (2000), chapter 11."""

    def __init__(self) -> None:
        k = np.arange(N + 1)
        x = np.cos(np.pi * k / N)
        c = np.where((k == 0) | (k == N), 2.0, 1.0) * (-1.0) ** k
        d = np.outer(c, 1.0 / c) / (x[:, None] - x[None, :] + np.eye(N + 1))
        d -= np.diag(d.sum(axis=1))
        h = 2.0 * np.pi / M
        j = np.arange(1, M)
        first = np.concatenate([[0.0], 0.5 * (-1.0) ** j / np.tan(0.5 * h * j)])
        second = np.concatenate([[-(np.pi**2) / (3.0 * h**2) - 1.0 / 6.0], -0.5 * (-1.0) ** j / np.sin(0.5 * h * j) ** 2])
        index = (np.arange(M)[:, None] - np.arange(M)[None, :]) % M
        half = (N + 1) // 2
        self.x, self.r, self.theta = x, x[:half], h * np.arange(M)
        # A point at -r and theta is the one at r and half a turn on.
        turn = np.roll(np.eye(M), M // 2, axis=0)
        radial = lambda a: np.kron(a[:half, :half], np.eye(M)) + np.kron(a[:half, N - k[:half]], turn)  # noqa: E731
        over_r = np.kron(np.diag(1.0 / self.r), np.eye(M))
        self.dr = radial(d)
        self.dt = np.kron(np.eye(half), first[index])
        self.laplace = radial(d @ d) + over_r @ self.dr + over_r @ over_r @ np.kron(np.eye(half), second[index])
        angle = np.tile(self.theta, half)
        cos, sin = np.diag(np.cos(angle)), np.diag(np.sin(angle))
        self.dx, self.dy = cos @ self.dr - sin @ over_r @ self.dt, sin @ self.dr + cos @ over_r @ self.dt
        self.n = half * M
        #: The first M points lie on the wall.
        self.wall = np.arange(self.n) < M
        # Quadrature of Clenshaw and Curtis over the diameter of |r| f, exact for what a polynomial of the order N is: by moments.
        order = np.arange(N + 1)
        moments = np.array([_moment(n) for n in order])
        weights = np.linalg.solve(np.cos(np.outer(order, np.pi * k / N)), moments)
        weight = weights[:half] + weights[N - k[:half]]
        self.weights = np.repeat(0.5 * weight, M) * h

    def diameter(self, f: np.ndarray) -> np.polynomial.Chebyshev:
        """Values along the diameter from inwards (-1) to outwards (1)."""
        grid = f.reshape(-1, M)
        values = np.concatenate([grid[:, 0], grid[::-1, M // 2]])
        return np.polynomial.Chebyshev.fit(self.x, values, N, domain=[-1.0, 1.0])


def _moment(n: int) -> float:
    """Integral of `|x| T_n(x)` from -1 to 1."""
    if n % 2:
        return 0.0
    t = np.polynomial.Chebyshev.basis(n) * np.polynomial.Chebyshev([0.0, 1.0])
    whole = t.integ()
    return 2.0 * float(whole(1.0) - whole(0.0))


class Flow:
    """Flow at a Dean number `Re sqrt(R / Rc)`, `Re` by the diameter. Lengths in radii, velocities along the tube in their mean, across it in `nu / R`.

    `u . grad w = G + lap w`, `u . grad vorticity = lap vorticity - K d(w^2)/dy` with K a quarter of the Dean number squared: the
    centrifugal force `w^2 / Rc` points outwards, along x.
    """

    def __init__(self, dean: float) -> None:
        disc = self.disc = Disc()
        n, wall = disc.n, disc.wall
        inner = ~wall
        r2 = np.repeat(disc.r**2, M)
        w, psi, vorticity, gradient = 2.0 * (1.0 - r2), np.zeros(n), np.zeros(n), 8.0
        # Newton's method wants a start nearby: the bend is made sharper in steps.
        climb = np.linspace(0.0, dean, 1 + int(np.ceil(dean / 15.0)))[1:]
        for k in range(len(climb) + 10):
            stiffness = 0.25 * climb[min(k, len(climb) - 1)] ** 2
            u, v = disc.dy @ psi, -disc.dx @ psi
            advect = u[:, None] * disc.dx + v[:, None] * disc.dy
            wx, wy, vx, vy = disc.dx @ w, disc.dy @ w, disc.dx @ vorticity, disc.dy @ vorticity
            zero = np.zeros((n, n))
            one = np.eye(n)
            # Residuals and their derivatives by w, psi, vorticity and G.
            rows = [
                (advect @ w - gradient - disc.laplace @ w, [advect - disc.laplace, wx[:, None] * disc.dy - wy[:, None] * disc.dx, zero, -np.ones((n, 1))]),
                (disc.laplace @ psi + vorticity, [zero, disc.laplace, one, np.zeros((n, 1))]),
                (
                    advect @ vorticity - disc.laplace @ vorticity + stiffness * disc.dy @ w**2,
                    [2.0 * stiffness * disc.dy * w[None, :], vx[:, None] * disc.dy - vy[:, None] * disc.dx, advect - disc.laplace, np.zeros((n, 1))],
                ),
            ]
            residual = [row[0][inner] for row in rows]
            jacobian = [np.hstack(row[1])[inner] for row in rows]
            # On the wall nothing moves: w, psi and its slope are zero, for which the vorticity there is free.
            nothing = np.zeros((M, 1))
            residual += [w[wall], psi[wall], (disc.dr @ psi)[wall], [disc.weights @ w - np.pi]]
            jacobian += [
                np.hstack([one[wall], zero[wall], zero[wall], nothing]),
                np.hstack([zero[wall], one[wall], zero[wall], nothing]),
                np.hstack([zero[wall], disc.dr[wall], zero[wall], nothing]),
                np.hstack([disc.weights, np.zeros(2 * n + 1)])[None, :],
            ]
            step = np.linalg.solve(np.vstack(jacobian), -np.concatenate(residual))
            w, psi, vorticity, gradient = w + step[:n], psi + step[n : 2 * n], vorticity + step[2 * n : 3 * n], gradient + step[-1]
            if k >= len(climb) and np.abs(step[:n]).max() < 1e-8:
                break
        else:
            raise ArithmeticError(f"Newton's method does not converge at a Dean number of {dean}")
        #: Friction over that of a straight tube, and velocities along and across.
        self.friction = gradient / 8.0
        self.along = w
        self.across = np.hypot(disc.dy @ psi, disc.dx @ psi)


def white(dean: float) -> float:
    """Friction over that of a straight tube, for Dean numbers of 11.6 to 2000: White, Proc. R. Soc. A 123 (1929) 645-663."""
    return 1.0 / (1.0 - (1.0 - (11.6 / dean) ** 0.45) ** (1.0 / 0.45))


def ito(dean: float) -> float:
    """The same for 13.5 to 2000: Ito, J. Basic Eng. 81 (1959) 123-134."""
    return 21.5 * dean / (1.56 + np.log10(dean)) ** 5.73
