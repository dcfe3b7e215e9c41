import sys

import crude_registration as cr

# Two scans: files of any kind, arrays of numpy, meshes.
source, target = sys.argv[1:3]
result = cr.register(source, target)  # no parameter is needed
print(result)
if result.status is cr.RegistrationStatus.REGISTERED:
    print(result.T_target_source)  # maps the source into the frame of the target
