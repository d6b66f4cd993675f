"""A campaign, as 11_campaign: methods on the same trials, with intervals, in numpy."""
import spf

from picture import Picture

picture = Picture((0, 0), (8, 4))
for row, method in enumerate(("space_time", "spf_empc", "orca")):
    scenario = spf.Scenario.from_dict({"family": "t2", "method": method, "noise": {"model": "walk", "level": 1},
                                       "trial": {"tracking": "ideal"}})
    result = spf.Campaign.of(scenario, trials=4, first=10000).run().rows[0]
    print(f"{method:12} {result['success']} of {result['trials']}, 95 % [{result['wilson_low']:.2f}, "
          f"{result['wilson_high']:.2f}], time ratio {result['travel_time_ratio']:.3f}")
    y = 3 - row
    picture.text((0.2, y - 0.05), f"{method}: {result['success']} of {result['trials']}")
    picture.line([(3 + 4.5 * result["wilson_low"], y), (3 + 4.5 * result["wilson_high"], y)], "robot", 3)
    picture.disc((3 + 4.5 * result["success_rate"], y), 0.08, "robot", 1)
picture.line([(3, 0.4), (7.5, 0.4)], "quiet")
picture.text((2.9, 0.1), "0")
picture.text((6.6, 0.1), "success 1")
picture.save("16_campaign.svg")
