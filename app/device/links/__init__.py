"""Wire protocols and ports; a link brings joint angles in and carries torques out.

Only what is light stands here, for the window; drivers are imported from their own modules.
"""

from app.device.links.link import BoardInfo, DeviceLink, Link, LinkStatus

__all__ = ["BoardInfo", "DeviceLink", "Link", "LinkStatus"]
