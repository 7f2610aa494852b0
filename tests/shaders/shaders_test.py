"""glslangValidator reads every variant of every shader: argv[1] writes their texts into a folder."""
import os
import subprocess
import sys
import tempfile

FILES_PER_RUN = 64

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    names = sorted(os.listdir(folder))
    failed = False
    for begin in range(0, len(names), FILES_PER_RUN):
        run = subprocess.run(["glslangValidator", *names[begin:begin + FILES_PER_RUN]], cwd=folder, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        # It repeats the name of each file; what else it says is a finding.
        said = [line for line in run.stdout.splitlines() if line and line not in names]
        if run.returncode != 0 or said:
            failed = True
            print(run.stdout)
sys.exit(1 if failed else 0)
