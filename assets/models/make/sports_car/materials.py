"""The materials of the car, as the MTL file has them. Kd + Ks of some goes above 1, as in many a file."""

# name: (Kd, Ks, other statements)
CAR = {
    "paint": (".80 .17 .008", ".34 .14 .05", "Ns 160\nPr .28\nPc 1\nPcr .03"),
    "gap_black": (".008 .008 .008", "0 0 0", "Ns 1"),
    "trim_black": (".022 .022 .023", ".04 .04 .04", "Ns 60\nPr .42"),
    "gloss_black": (".01 .01 .011", ".05 .05 .05", "Ns 2000\nPr .06\nPc 1\nPcr .02"),
    "carbon": (".5 .5 .5", ".06 .06 .06", "Ns 400\nPr .22\nPc 1\nPcr .04\nmap_Kd sports-car/carbon.png"),
    "rubber": (".018 .018 .018", ".03 .03 .03", "Ns 30\nPr .55"),
    "frit": (".006 .006 .006", ".05 .05 .05", "Ns 4000\nPr .03"),
    "glass_windscreen": (".01 .012 .012", ".06 .06 .06", "Ns 8000\nPr .01\nd .06\nTf .90 .95 .92\nNi 1.5"),
    "glass_side": (".01 .012 .012", ".06 .06 .06", "Ns 8000\nPr .01\nd .08\nTf .84 .89 .87\nNi 1.5"),
    "glass_rear": (".01 .011 .012", ".06 .06 .06", "Ns 8000\nPr .01\nd .12\nTf .75 .80 .80\nNi 1.5"),
    "mirror": (".02 .02 .02", ".88 .89 .9", "Ns 10000\nillum 3"),
    "chrome": (".02 .02 .02", ".82 .83 .85", "Ns 900\nPr .08"),
    "lamp_lens": (".01 .01 .01", ".06 .06 .06", "Ns 8000\nPr .01\nd .1\nNi 1.5"),
    "lamp_housing": (".03 .03 .032", ".10 .10 .10", "Ns 120\nPr .3"),
    "lamp_glow": (".25 .27 .30", ".55 .56 .6", "Ns 3000\nPr .05\nKe .03 .032 .036"),
    "lamp_light": (".8 .8 .8", ".1 .1 .1", "Ns 100\nKe 1.6 1.7 1.85"),
    "indicator": (".8 .35 .03", ".2 .2 .2", "Ns 300\nPr .15"),
    "tail_lens": (".20 .004 .006", ".06 .06 .06", "Ns 6000\nPr .02\nd .3\nTf .95 .08 .06\nNi 1.5"),
    "tail_light": (".6 .02 .02", ".1 .05 .05", "Ns 100\nKe .9 .02 .015"),
    "tail_reflector": (".30 .006 .008", ".25 .02 .02", "Ns 300\nPr .2"),
    "grille": (".05 .05 .052", ".08 .08 .08", "Ns 200\nPr .3\nmap_d sports-car/mesh.png"),
    "grille_fine": (".03 .03 .031", ".08 .08 .08", "Ns 200\nPr .3\nmap_d sports-car/mesh.png"),
    "plate": (".5 .5 .5", ".05 .05 .05", "Ns 500\nPr .2\nmap_Kd sports-car/plate.png"),
    "rim": (".10 .10 .105", ".42 .42 .44", "Ns 300\nPr .28\nPc 1\nPcr .05"),
    "disc": (".5 .5 .5", ".45 .45 .45", "Ns 90\nPr .32\nmap_Kd sports-car/disc.png\nmap_Ks sports-car/disc.png"),
    "caliper": (".85 .42 .02", ".08 .08 .08", "Ns 600\nPr .2\nPc 1\nPcr .05"),
    "tyre": (".022 .022 .022", ".035 .035 .035", "Ns 20\nPr .6"),
    "exhaust": (".08 .075 .07", ".62 .58 .54", "Ns 500\nPr .22"),
    "liner": (".015 .015 .015", "0 0 0", "Ns 5"),
    "underbody": (".02 .02 .02", "0 0 0", "Ns 5"),
    "leather_dark": (".11 .11 .115", ".04 .04 .04", "Ns 40\nPr .5"),
    "leather": (".8 .8 .8", ".04 .04 .04", "Ns 40\nPr .45\nmap_Kd sports-car/leather.png"),
    "alcantara": (".12 .12 .125", "0 0 0", "Ns 5"),
    "lining": (".35 .35 .34", "0 0 0", "Ns 5"),
    "carpet": (".07 .07 .075", "0 0 0", "Ns 5"),
    "belt": (".03 .03 .03", ".02 .02 .02", "Ns 20"),
    "screen": ("0.02 0.02 0.02", ".05 .05 .05", "Ns 2000\nPr .05\nKe .5 .5 .5\nmap_Ke sports-car/screen.png"),
}

ROAD = {
    "asphalt": (".5 .5 .5", ".06 .06 .06", "Ns 12\nPr .62\nmap_Kd sports-car/asphalt.jpg\nmap_Bump -bm 0.35 sports-car/asphalt-bump.jpg"),
    "marking": (".5 .5 .5", ".05 .05 .05", "Ns 20\nPr .5\nmap_Kd sports-car/marking.jpg"),
    "asphalt_new": (".34 .34 .35", ".06 .06 .06", "Ns 20\nPr .55\nmap_Kd sports-car/asphalt.jpg\nmap_Bump -bm 0.35 sports-car/asphalt-bump.jpg"),
    "bitumen": (".018 .018 .019", ".06 .06 .06", "Ns 60\nPr .34"),
    "iron": (".055 .05 .046", ".12 .115 .11", "Ns 60\nPr .42"),
    "gap": (".006 .006 .006", "0 0 0", "Ns 1"),
    "kerb": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/concrete.jpg"),
    "pavement": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/paving.jpg"),
    "wall": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/stone.jpg"),
    "wall_cap": (".62 .60 .56", "0 0 0", "Ns 5\nmap_Kd sports-car/concrete.jpg"),
    "mortar": (".30 .29 .27", "0 0 0", "Ns 5"),
    "grass": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/grass.jpg"),
    "blades": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/blades.png\nmap_d sports-car/blades.png"),
    "bark": (".12 .09 .07", "0 0 0", "Ns 5"),
    "leaves": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/leaves.png\nmap_d sports-car/leaves.png"),
    "hills": (".5 .5 .5", "0 0 0", "Ns 5\nmap_Kd sports-car/hills.jpg"),
}


def write(path, comment, table):
    lines = ["# " + comment]
    for name, (kd, ks, more) in table.items():
        statements = more.split("\n")
        if not any(s.startswith("illum") for s in statements):
            statements.append("illum " + ("1" if ks == "0 0 0" else "2"))
        lines += ["", "newmtl " + name, "Kd " + kd, "Ks " + ks] + statements
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
