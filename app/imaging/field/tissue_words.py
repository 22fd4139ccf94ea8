"""Names of tissues for people: those that this program gives stay translatable.

A name that somebody else gave, as a segmentation does, comes as it stands.
"""

from functools import cache

from app.core.messages import sentence


def tissue_words(name: str) -> str:
    """Return a tissue's name, or a structure's, as a sentence of its own where it is one of ours.

    Args:
        name: as a field, a record or an exercise has it; underscores count as blanks.
    """
    return _ours().get(name.replace("_", " ").casefold(), name)


@cache
def _ours() -> dict[str, str]:
    """Return the text of each name -> itself, as a sentence."""
    kinds = (
        sentence("unknown"),
        sentence("air"),
        sentence("lung"),
        sentence("skin"),
        sentence("fat"),
        sentence("muscle"),
        sentence("organ"),
        sentence("vessel"),
        sentence("gut"),
        sentence("heart"),
        sentence("bone"),
    )
    soft = (
        sentence("diaphragm"),
        sentence("cartilage"),
        sentence("disc"),
        sentence("liver"),
        sentence("gallbladder"),
        sentence("pancreas"),
        sentence("spleen"),
        sentence("kidney"),
        sentence("adrenal"),
        sentence("bladder"),
        sentence("prostate"),
        sentence("uterus"),
        sentence("thyroid"),
        sentence("brain"),
        sentence("lesion"),
        sentence("nodule"),
        sentence("lung nodule"),
        sentence("tumour"),
        sentence("cyst"),
        sentence("spinal canal"),
    )
    hollow = (
        sentence("gas"),
        sentence("stomach"),
        sentence("small bowel"),
        sentence("colon"),
        sentence("duodenum"),
        sentence("trachea"),
        sentence("bronchus"),
        sentence("oesophagus"),
    )
    vessels = (
        sentence("small vessel"),
        sentence("lung vessel"),
        sentence("artery"),
        sentence("vein"),
        sentence("aorta"),
        sentence("vena cava"),
        sentence("portal vein"),
        sentence("hepatic vein"),
        sentence("contrast"),
        sentence("bone or contrast"),
    )
    chest = (
        sentence("right upper lobe"),
        sentence("right middle lobe"),
        sentence("right lower lobe"),
        sentence("left upper lobe"),
        sentence("left lower lobe"),
        sentence("emphysema"),
        sentence("intercostal artery"),
        sentence("intercostal vein"),
    )
    bones = (
        sentence("rib"),
        sentence("vertebra"),
        sentence("sternum"),
        sentence("scapula"),
        sentence("spine"),
        sentence("pelvis"),
    )
    return {str(one): one for one in (*kinds, *soft, *hollow, *vessels, *chest, *bones)}
