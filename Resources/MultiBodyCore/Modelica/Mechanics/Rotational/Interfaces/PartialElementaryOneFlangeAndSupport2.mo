within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialElementaryOneFlangeAndSupport2 "Component with a flange and, if wanted, a support"
  parameter Boolean useSupport=false "= true, if the support exists, else the housing stands still";
  Flange_b flange "Flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Support support(phi=phi_support, tau=-flange.tau) if useSupport "Housing" annotation (Placement(transformation(extent={{-10,-110},{10,-90}})));
protected
  SI.Angle phi_support "Angle of the housing";
equation
  if not useSupport then
    phi_support = 0;
  end if;
  annotation (Documentation(info="<html><p>Base class of sources. The housing takes the reaction of the flange.</p></html>"));
end PartialElementaryOneFlangeAndSupport2;
