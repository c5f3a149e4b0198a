"""Real clips from outside the repository: all pictures come back, within the limits of clip_floors.txt.
Skipped where ../shared/clips is missing; FBS_SHARED names another folder."""
from clips import FLOORS, Row, measure
from harness import ProgramTest


class Clips(ProgramTest):
    def clip(self, floor):
        found = measure(self, floor.clip, floor.frames)
        print(Row.heading(), floor, found, sep="\n")
        self.assertGreaterEqual(found.face_db, floor.face_db)
        self.assertGreaterEqual(found.frame_db, floor.frame_db)
        self.assertLessEqual(found.startup_bytes, floor.startup_bytes)
        self.assertLessEqual(found.motion_kbps, floor.motion_kbps)
        self.assertLessEqual(found.total_kbps, floor.total_kbps)


for row in FLOORS:
    setattr(Clips, "test_" + row.clip, lambda self, row=row: self.clip(row))
