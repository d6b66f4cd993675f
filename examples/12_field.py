"""The safety probability field of 01_field, in numpy: its risk where a robot might go."""
import numpy as np
import spf

from picture import Picture

field = spf.ProbabilityField(position=(0, 0), velocity=(0.9, 0), radius=0.3)

picture = Picture((-2.5, -2.0), (5.5, 2.0))
for m in np.arange(2.4, 0.1, -0.3):  # the fuller the colour, the higher the risk
    contour = field.ellipse(m)
    picture.ellipse(contour["center"], contour["half_axes"], contour["heading"], "obstacle", 0.12)
limit = field.ellipse(field.threshold)
picture.ellipse(limit["center"], limit["half_axes"], limit["heading"], "limit", 0.0)
picture.disc((0, 0), 0.3, "obstacle", 0.9)
picture.text((-2.4, 1.75), "risk for a robot's centre; red: where it counts as dangerous")
picture.save("12_field.svg")

x, y = np.meshgrid(np.linspace(-2.5, 5.5, 81), np.linspace(-2, 2, 41))
points = np.stack([x, y], axis=-1)
dangerous = field.mahalanobis(points) < field.threshold
print(f"dangerous up to a Mahalanobis distance of {field.threshold:.2f}: {dangerous.mean() * 32:.1f} of 32 m^2")
print(f"highest risk {field.risk(points).max():.3f} at {points[np.unravel_index(field.risk(points).argmax(), x.shape)]}")
